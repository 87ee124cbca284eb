#pragma once
// A transfer function as a table of a larger TOML document.

#include <toml++/toml.h>

#include "common/view/anchored_function.h"

namespace shearwater::view {

// As transfer_function_from_toml, lines counted in the document. `operation` is what an error says was done.
base::Result<AnchoredFunction> transfer_function_from_table(const toml::table& table,
                                                            const std::string& operation);

}  // namespace shearwater::view
