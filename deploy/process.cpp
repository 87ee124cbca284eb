#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "common/base/own_program.h"
#include "deploy/local_tree.h"

namespace shearwater::deploy {
namespace {

using namespace std::chrono_literals;

// What runs between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* path, char* const* arguments, char* const* environment, int out,
                         pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
        _exit(127);
    }
    // A terminal's interrupt is for the command, which then ends its daemons in order.
    setpgid(0, 0);
    if (out >= 0) {
        dup2(out, STDOUT_FILENO);
    }
    execve(path, arguments, environment);
    _exit(127);
}

std::vector<std::string> environment_with(const link::Secret& secret) {
    const std::string prefix = std::string(link::Secret::variable) + "=";
    std::vector<std::string> entries;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        if (std::strncmp(*entry, prefix.c_str(), prefix.size()) != 0) {
            entries.emplace_back(*entry);
        }
    }
    entries.push_back(prefix + secret.text());
    return entries;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> list;
    for (std::string& word : words) {
        list.push_back(word.data());
    }
    list.push_back(nullptr);
    return list;
}

}  // namespace

base::Result<Process> Process::start(const std::string& program, const std::vector<std::string>& arguments,
                                     const link::Secret& secret, int out) {
    const std::string path = base::beside_this_program(program);
    if (access(path.c_str(), X_OK) != 0) {
        return base::error(base::Code::not_found, "start " + program, path + ": " + std::strerror(errno));
    }
    std::vector<std::string> words{path};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> entries = environment_with(secret);
    const std::vector<char*> argv = pointers(words);
    const std::vector<char*> envp = pointers(entries);
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child == 0) {
        become(path.c_str(), argv.data(), envp.data(), out, parent);
    }
    if (child < 0) {
        return base::error(base::Code::io, "start " + program, std::strerror(errno));
    }
    return Process(child);
}

Process::Process(Process&& other) noexcept : id_(std::exchange(other.id_, -1)) {}

Process& Process::operator=(Process&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
}

Process::~Process() {
    ask_to_end();
    for (int i = 0; i < 300 && !ended(); ++i) {
        std::this_thread::sleep_for(10ms);
    }
    if (id_ > 0) {
        kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }
}

std::optional<int> Process::ended() {
    if (id_ <= 0) {
        return 0;
    }
    int status = 0;
    if (waitpid(id_, &status, WNOHANG) != id_) {
        return std::nullopt;
    }
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void Process::ask_to_end() {
    if (id_ > 0) {
        kill(id_, SIGTERM);
    }
}

}  // namespace shearwater::deploy
