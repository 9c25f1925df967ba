/*
 * denavit.hpp: denavit.h for C++11 and later. Objects free themselves, arrays are vectors, errors are exceptions.
 *
 * Everything is as denavit.h says: units, order, threads. Robots and solvers are handles, cheap to copy, that share what they stand for.
 */
#ifndef DENAVIT_HPP
#define DENAVIT_HPP

#include <denavit.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace denavit {

using pose = denavit_pose;

/** A finding in a description. */
struct finding {
    denavit_finding_severity severity;
    std::string file;
    std::size_t line, column;
    std::string message, hint, rendered;

    explicit finding(const denavit_finding &f)
        : severity(f.severity), file(f.file), line(f.line), column(f.column), message(f.message),
          hint(f.hint ? f.hint : ""), rendered(f.rendered) {}
};

/** Nothing was computed: a negative status, with its words, and the findings of a description. */
class error : public std::runtime_error {
  public:
    explicit error(denavit_status status) : std::runtime_error(denavit_error_message()), status_(status) {
        denavit_finding f;
        for (std::size_t i = 0, n = denavit_error_findings(); i < n; i++)
            if (denavit_error_finding(i, &f) == DENAVIT_OK) findings_.emplace_back(f);
    }
    denavit_status status() const noexcept { return status_; }
    const std::vector<finding> &findings() const noexcept { return findings_; }

  private:
    denavit_status status_;
    std::vector<finding> findings_;
};

/** The status, if it is none of an error. */
inline denavit_status needed(denavit_status status) {
    if (status < 0) throw error(status);
    return status;
}

/** How a description is read. */
struct options {
    std::string base, tip, columns;
    denavit_convention convention = DENAVIT_CONVENTION_NONE;
    bool as_written = false;
    int angles = 0, lengths = 0; // 1 radians, 2 degrees; 1 metres, 2 millimetres
    std::size_t table = 0;
    std::vector<std::string> arguments, packages; // names and values in turn
};

/** A joint. */
struct joint {
    std::string variable, name;
    denavit_joint_kind kind;
    bool limited;
    double lower, upper, velocity;
};

class robot {
  public:
    /** Of the catalogue. */
    static robot catalogue(const std::string &name, const options &how = options()) {
        const given g(how);
        denavit_robot *made = nullptr;
        needed(denavit_robot_catalogue(name.c_str(), &g.raw, &made));
        return robot(made);
    }
    /** From a file. */
    static robot file(const std::string &path, const options &how = options()) {
        const given g(how);
        denavit_robot *made = nullptr;
        needed(denavit_robot_file(path.c_str(), &g.raw, &made));
        return robot(made);
    }
    /** From a text; `format` is the ending that a file of it would have, or empty. */
    static robot text(const std::string &text, const std::string &format = "", const options &how = options()) {
        const given g(how);
        denavit_robot *made = nullptr;
        needed(denavit_robot_text(text.data(), text.size(), format.empty() ? nullptr : format.c_str(), &g.raw, &made));
        return robot(made);
    }
    /** From a table: 4 cells a row in the order of the convention, a kind a row, and nothing or two limits a row. */
    static robot table(denavit_convention convention, const std::vector<double> &cells,
                       const std::vector<denavit_joint_kind> &kinds, const std::vector<double> &limits = {},
                       const pose *base = nullptr, const pose *tool = nullptr) {
        denavit_robot *made = nullptr;
        needed(denavit_robot_table(convention, kinds.size(), cells.data(), cells.size(), kinds.data(), kinds.size(),
                                   limits.data(), limits.size(), base, tool, &made));
        return robot(made);
    }
    /** Another chain of what it was read from; an empty name is none. */
    robot chain(const std::string &base, const std::string &tip) const {
        denavit_robot *made = nullptr;
        needed(denavit_robot_chain(get(), base.empty() ? nullptr : base.c_str(), tip.empty() ? nullptr : tip.c_str(), &made));
        return robot(made);
    }
    /** With a value for a parameter. */
    robot set(const std::string &name, double value) const {
        denavit_robot *made = nullptr;
        needed(denavit_robot_set(get(), name.c_str(), value, &made));
        return robot(made);
    }

    std::string name() const { return said(denavit_robot_name); }
    std::string toml() const { return said(denavit_robot_toml); }
    std::size_t joints() const { return joints_; }
    joint joint_at(std::size_t index) const {
        denavit_joint j;
        needed(denavit_robot_joint(get(), index, &j));
        return {j.variable, j.name ? j.name : "", j.kind, j.limited != 0, j.lower, j.upper, j.velocity};
    }
    bool has_masses() const {
        std::int32_t has = 0;
        needed(denavit_robot_has_masses(get(), &has));
        return has != 0;
    }
    std::vector<finding> findings() const {
        std::size_t n = 0;
        needed(denavit_robot_findings(get(), &n));
        std::vector<finding> all;
        denavit_finding f;
        for (std::size_t i = 0; i < n; i++) {
            needed(denavit_robot_finding(get(), i, &f));
            all.emplace_back(f);
        }
        return all;
    }

    pose fk(const std::vector<double> &q) const {
        pose x;
        needed(denavit_fk(get(), q.data(), q.size(), &x));
        return x;
    }
    /** Frames 0, 1, … of the table, then the tool. */
    std::vector<pose> frames(const std::vector<double> &q) const {
        std::size_t n = 0;
        needed(denavit_robot_frames(get(), &n));
        std::vector<pose> all(n + 1);
        needed(denavit_frames(get(), q.data(), q.size(), all.data(), all.size()));
        return all;
    }
    /** 6 x n, row by row. */
    std::vector<double> jacobian(const std::vector<double> &q, std::int32_t of = DENAVIT_TOOL,
                                 std::int32_t axes = DENAVIT_BASE) const {
        std::vector<double> all(6 * joints_);
        needed(denavit_jacobian(get(), of, axes, q.data(), q.size(), all.data(), all.size()));
        return all;
    }
    std::vector<double> torque(const std::vector<double> &q, const std::vector<double> &qd,
                               const std::vector<double> &qdd) const {
        return evaluate(DENAVIT_FUNCTION_TORQUE, {&q, &qd, &qdd});
    }
    std::vector<double> acceleration(const std::vector<double> &q, const std::vector<double> &qd,
                                     const std::vector<double> &torque) const {
        return evaluate(DENAVIT_FUNCTION_ACCELERATION, {&q, &qd, &torque});
    }
    std::vector<double> gravity(const std::vector<double> &q) const { return evaluate(DENAVIT_FUNCTION_GRAVITY, {&q}); }
    /** n x n, row by row. */
    std::vector<double> inertia(const std::vector<double> &q) const { return evaluate(DENAVIT_FUNCTION_INERTIA, {&q}); }
    /** Any function of one state: the vectors that it reads, in their order. */
    std::vector<double> evaluate(denavit_function function, const std::vector<const std::vector<double> *> &vectors) const {
        std::vector<double> state;
        for (const std::vector<double> *v : vectors) state.insert(state.end(), v->begin(), v->end());
        return evaluate(function, 1, state, 1);
    }
    /** A function of many states, a row each. */
    std::vector<double> evaluate(denavit_function function, std::size_t rows, const std::vector<double> &inputs,
                                 std::size_t threads = 0) const {
        std::size_t outputs = 0;
        needed(denavit_prepare(get(), function, nullptr, &outputs));
        std::vector<double> all(rows * outputs);
        needed(denavit_evaluate(get(), function, rows, inputs.data(), inputs.size(), all.data(), all.size(), threads));
        return all;
    }

    const denavit_robot *get() const noexcept { return own_.get(); }

  private:
    /** Options as C has them; they hold what they point to. */
    struct given {
        denavit_options raw;
        std::vector<const char *> arguments, packages;
        explicit given(const options &how) : raw() {
            const auto some = [](const std::string &s) { return s.empty() ? nullptr : s.c_str(); };
            for (const std::string &s : how.arguments) arguments.push_back(s.c_str());
            for (const std::string &s : how.packages) packages.push_back(s.c_str());
            raw.base = some(how.base);
            raw.tip = some(how.tip);
            raw.columns = some(how.columns);
            raw.convention = how.convention;
            raw.as_written = how.as_written;
            raw.angles = how.angles;
            raw.lengths = how.lengths;
            raw.table = how.table;
            raw.arguments = arguments.data();
            raw.arguments_length = arguments.size();
            raw.packages = packages.data();
            raw.packages_length = packages.size();
        }
    };
    explicit robot(denavit_robot *made) : own_(made, denavit_robot_free), joints_(0) {
        needed(denavit_robot_joints(made, &joints_));
    }
    std::string said(denavit_status (*ask)(const denavit_robot *, const char **)) const {
        const char *text = "";
        needed(ask(get(), &text));
        return text;
    }
    std::shared_ptr<denavit_robot> own_;
    std::size_t joints_;
};

/** A solution of the inverse kinematics. */
struct solution {
    std::vector<double> q;
    double residual, guard;
    std::uint64_t copies;
    unsigned multiplicity;
    bool within_limits;
    std::string branch;
};

/** Configurations with the pose that hang together: q is one of them. */
struct family {
    std::vector<double> q, direction;
    std::vector<std::vector<double>> members;
    std::size_t dimension;
    bool affine;
    std::string free_unknowns;
};

class answer {
  public:
    /** 0 to 5: see denavit_status. */
    denavit_status status() const { return needed(denavit_answer_status(own_.get())); }
    bool complete() const {
        denavit_doubt doubt = DENAVIT_DOUBT_NONE;
        needed(denavit_answer_doubt(own_.get(), &doubt));
        return doubt == DENAVIT_DOUBT_NONE;
    }
    std::vector<solution> solutions() const {
        std::size_t n = 0;
        needed(denavit_answer_counts(own_.get(), &n, nullptr, nullptr));
        std::vector<solution> all;
        denavit_solution s;
        for (std::size_t i = 0; i < n; i++) {
            std::vector<double> q(joints_);
            needed(denavit_answer_solution(own_.get(), i, q.data(), joints_, &s));
            all.push_back({q, s.residual, s.guard, s.copies, s.multiplicity, s.within_limits != 0, s.branch});
        }
        return all;
    }
    std::vector<family> families() const {
        std::size_t n = 0;
        needed(denavit_answer_counts(own_.get(), nullptr, &n, nullptr));
        std::vector<family> all;
        denavit_family f;
        for (std::size_t i = 0; i < n; i++) {
            std::vector<double> q(joints_), direction(joints_);
            needed(denavit_answer_family(own_.get(), i, q.data(), direction.data(), joints_, &f));
            std::vector<double> flat(f.members * joints_), stretches(2 * f.stretches);
            needed(denavit_answer_members(own_.get(), i, flat.data(), flat.size(), stretches.data(), stretches.size()));
            std::vector<std::vector<double>> members;
            for (std::size_t k = 0; k < f.members; k++)
                members.emplace_back(flat.begin() + static_cast<std::ptrdiff_t>(k * joints_),
                                     flat.begin() + static_cast<std::ptrdiff_t>((k + 1) * joints_));
            all.push_back({q, direction, members, f.dimension, f.affine != 0, f.free_unknowns});
        }
        return all;
    }
    /** The configurations within the limits that solution `index` stands for, at most so many. */
    std::vector<std::vector<double>> copies(std::size_t index, std::size_t most = 1000) const {
        std::vector<double> flat(most * joints_);
        std::size_t n = 0;
        needed(denavit_answer_copies(own_.get(), index, flat.data(), flat.size(), &n));
        std::vector<std::vector<double>> all;
        for (std::size_t k = 0; k < n; k++)
            all.emplace_back(flat.begin() + static_cast<std::ptrdiff_t>(k * joints_),
                             flat.begin() + static_cast<std::ptrdiff_t>((k + 1) * joints_));
        return all;
    }
    /** The configuration nearest to another; empty if there is none. */
    std::vector<double> nearest(const std::vector<double> &to) const {
        std::vector<double> q(to.size());
        if (needed(denavit_answer_nearest(own_.get(), to.data(), to.size(), q.data(), nullptr)) != DENAVIT_OK) q.clear();
        return q;
    }
    /** Why there is no solution; empty if there is one. */
    std::string obstacle() const {
        std::vector<double> q(joints_);
        denavit_obstacle o;
        const denavit_status known = needed(denavit_answer_obstacle(own_.get(), q.data(), joints_, &o));
        return known == DENAVIT_OK ? o.message : "";
    }

  private:
    friend class solver;
    answer(denavit_answer *made, std::size_t joints) : own_(made, denavit_answer_free), joints_(joints) {}
    std::shared_ptr<denavit_answer> own_;
    std::size_t joints_;
};

/** Inverse kinematics, prepared. */
class solver {
  public:
    explicit solver(const robot &of, denavit_goal goal = DENAVIT_GOAL_POSE, const std::vector<std::size_t> &given = {})
        : joints_(of.joints()) {
        denavit_solver *made = nullptr;
        needed(denavit_solver_new(of.get(), goal, given.data(), given.size(), &made));
        own_.reset(made, denavit_solver_free);
    }
    std::string method() const {
        const char *text = "";
        needed(denavit_solver_method(own_.get(), &text));
        return text;
    }
    answer solve(const pose &x, bool within_limits = false, const std::vector<double> &given = {}) const {
        denavit_answer *made = nullptr;
        needed(denavit_solve(own_.get(), &x, given.data(), given.size(), within_limits, &made));
        return answer(made, joints_);
    }
    /** Goes on from q to a pose: see denavit_track. */
    denavit_status track(const pose &x, std::vector<double> &q, denavit_tracked *told = nullptr) const {
        return needed(denavit_track(own_.get(), &x, q.data(), q.size(), q.data(), told));
    }

  private:
    std::shared_ptr<denavit_solver> own_;
    std::size_t joints_;
};

} // namespace denavit

#endif
