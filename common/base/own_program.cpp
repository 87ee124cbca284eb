#include "common/base/own_program.h"

#include <filesystem>

namespace shearwater::base {

std::string beside_this_program(const std::string& program) {
    std::error_code failed;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", failed);
    return failed ? program : (self.parent_path() / program).string();
}

}  // namespace shearwater::base
