#pragma once
// Our programs find one another by lying in one folder.

#include <string>

namespace shearwater::base {

// The path of `program` in the folder of the program that runs; its bare name where that is not known.
std::string beside_this_program(const std::string& program);

}  // namespace shearwater::base
