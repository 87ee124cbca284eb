#pragma once
// Where a person's secrets lie between the commands that use them.

#include <string>

#include "protocol/link/secret.h"

namespace shearwater::deploy {

// The secret the person chose, by file or environment; else a fresh one. `fresh` says which.
struct ChosenSecret {
    link::Secret secret;
    bool fresh;
};
base::Result<ChosenSecret> choose_secret(const std::string& file);

// Writes the secret of the server on `port` where only its owner can read it and returns the path.
base::Result<std::string> keep_secret(const link::Secret& secret, unsigned port);

}  // namespace shearwater::deploy
