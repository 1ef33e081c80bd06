// Modules: shared libraries of ours beside the program that are opened on first need, because what they are linked with
// takes long to start.
#pragma once

#include <dlfcn.h>

#include <cstdint>
#include <string>

#include "core/error.h"

namespace lancer {

// Opens NAME.so beside the program (a build folder), one up (test programs) or in LANCER_INSTALLED_MODULES (installed:
// a path from the program's folder, so that the installed tree may lie anywhere); its function NAME_version must give
// `version`. It is never closed: the libraries behind it do not survive that. Throws Error (failed); missing: what a
// message says of a module that is not there.
void* open_module(const std::string& name, int32_t version, const std::string& missing);

template <class Function>
void find_symbol(void* library, const char* name, Function& function)
{
    function = reinterpret_cast<Function>(dlsym(library, name));
    if (!function) throw Error(ErrorKind::failed, std::string("error: a module lacks ") + name);
}

}  // namespace lancer
