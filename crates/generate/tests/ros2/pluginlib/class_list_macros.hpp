#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace pluginlib {

/* What makes plug-ins of a base class, by the names of the classes. */
template <class Base> std::map<std::string, std::function<std::unique_ptr<Base>()>> &makers()
{
    static std::map<std::string, std::function<std::unique_ptr<Base>()>> all;
    return all;
}

template <class Derived, class Base> struct Entry {
    explicit Entry(const char *name)
    {
        makers<Base>()[name] = [] { return std::unique_ptr<Base>(new Derived); };
    }
};

} // namespace pluginlib

#define PLUGINLIB_EXPORT_CLASS(Derived, Base) \
    static const pluginlib::Entry<Derived, Base> plugin_entry(#Derived);
