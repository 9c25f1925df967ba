// Pinocchio's generated code for the arms: C by CppADCodeGen, written into the folder that is named.
#include <pinocchio/codegen/cppadcg-algo.hpp>

#include <string>

#include "model.hpp"
#include "ur5.inc"
#include "panda.inc"

namespace {

// A generator with its sources written out.
template <class Generator> struct Written : Generator {
    using Generator::Generator;

    void write(const std::string &folder)
    {
        this->build_jacobian = false;
        this->initLib();
        CppAD::cg::SaveFilesModelLibraryProcessor<double>(*this->libcgen_ptr).saveSourcesTo(folder);
    }
};

void arm(const Link *links, int n, const std::string &name, const std::string &folder)
{
    const pinocchio::Model model = model_of(links, n);
    Written<pinocchio::CodeGenRNEA<double>>(model, name + "_rnea", name).write(folder);
    Written<pinocchio::CodeGenCRBA<double>>(model, name + "_crba", name).write(folder);
    Written<pinocchio::CodeGenABA<double>>(model, name + "_aba", name).write(folder);
    Written<pinocchio::CodeGenRNEADerivatives<double>>(model, name + "_derivatives", name).write(folder);
}

} // namespace

int main(int, char **arguments)
{
    arm(ur5_links, 6, "ur5", arguments[1]);
    arm(panda_links, 7, "panda", arguments[1]);
    return 0;
}
