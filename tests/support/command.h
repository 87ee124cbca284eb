#pragma once
// The command as a person types it.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace shearwater::support {

struct Outcome {
    int status = -1;
    std::string out;
    std::string err;
};

inline Outcome run(const std::string& arguments) {
    const TemporaryFolder scratch;
    const std::string command = std::string("timeout 60 ") + SHEARWATER_BIN + "/shearwater " + arguments +
                                " 2>" + scratch.path("err") + " </dev/null";
    Outcome outcome;
    FILE* const pipe = popen(command.c_str(), "r");
    std::array<char, 4096> chunk{};
    for (std::size_t got = 0; (got = fread(chunk.data(), 1, chunk.size(), pipe)) > 0;) {
        outcome.out.append(chunk.data(), got);
    }
    const int ended = pclose(pipe);
    outcome.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
    std::ostringstream text;
    text << std::ifstream(scratch.path("err")).rdbuf();
    outcome.err = text.str();
    return outcome;
}

// Exit status 2 and one line that says what and why.
inline void expect_mistake(const std::string& arguments, const std::string& word) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << arguments << "\n" << outcome.err;
}

}  // namespace shearwater::support
