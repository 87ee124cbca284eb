#include "protocol/link/child_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>
#include <utility>

namespace shearwater::link {

namespace {

using namespace std::chrono_literals;

// What the child is told to do with its descriptors; freed with this.
class FileActions {
  public:
    FileActions() { posix_spawn_file_actions_init(&actions_); }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;

    void give(int ours, int theirs) { posix_spawn_file_actions_adddup2(&actions_, ours, theirs); }
    const posix_spawn_file_actions_t* get() const { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_;
};

void say(const std::string& line) {
    std::fprintf(stderr, "%s\n", line.c_str());
}

bool has_ended(int pid) {
    return waitpid(pid, nullptr, WNOHANG) != 0;
}

}  // namespace

base::Result<std::shared_ptr<ChildProgram>> ChildProgram::start(boost::asio::io_context& io,
                                                                const std::vector<std::string>& command) {
    const std::string operation = "start " + command.at(0);
    std::array<int, 2> stream{-1, -1};
    std::array<int, 2> errors{-1, -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, stream.data()) != 0) {
        return base::error(base::Code::io, operation, std::strerror(errno));
    }
    if (pipe2(errors.data(), O_CLOEXEC) != 0) {
        const std::string why = std::strerror(errno);
        close(stream[0]);
        close(stream[1]);
        return base::error(base::Code::io, operation, why);
    }
    FileActions actions;
    actions.give(stream[1], STDIN_FILENO);
    actions.give(stream[1], STDOUT_FILENO);
    actions.give(errors[1], STDERR_FILENO);
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    pid_t pid = -1;
    const int failed = posix_spawnp(&pid, arguments[0], actions.get(), nullptr, arguments.data(), environ);
    close(stream[1]);
    close(errors[1]);
    if (failed != 0) {
        close(stream[0]);
        close(errors[0]);
        return base::error(failed == ENOENT ? base::Code::not_found : base::Code::io, operation,
                           std::strerror(failed));
    }
    std::shared_ptr<ChildProgram> child(new ChildProgram(io, pid, stream[0], errors[0]));
    child->listen();
    return child;
}

ChildProgram::ChildProgram(boost::asio::io_context& io, int pid, int stream, int errors)
    : pid_(pid), stream_(stream), errors_(io, errors) {
    errors_.non_blocking(true);
}

ChildProgram::~ChildProgram() {
    if (stream_ >= 0) {
        close(stream_);
    }
    constexpr int patience = 10;
    for (int i = 0; i < patience && !has_ended(pid_); ++i) {
        if (i == 1) {
            kill(pid_, SIGTERM);
        }
        if (i + 1 == patience) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
            return;
        }
        std::this_thread::sleep_for(5ms);
    }
}

void ChildProgram::listen() {
    errors_.async_read_some(
        boost::asio::buffer(room_),
        [weak = weak_from_this()](const boost::system::error_code& ended, std::size_t size) {
            const auto self = weak.lock();
            if (self && !ended) {
                self->hear({self->room_.data(), size});
                self->listen();
            }
        });
}

void ChildProgram::hear(std::string_view text) {
    constexpr std::size_t longest = 400, most_lines = 20;
    for (const char c : text) {
        if (c != '\n' && c != '\r') {
            if (line_.size() < longest) {
                line_ += c;
            }
        } else if (!line_.empty()) {
            lines_.push_back(base::printable(std::exchange(line_, {}), longest));
            if (lines_.size() > most_lines) {
                lines_.pop_front();
            }
            if (speaks_out_) {
                say(lines_.back());
            }
        }
    }
}

void ChildProgram::speak_out() {
    speaks_out_ = true;
    for (const std::string& line : lines_) {
        say(line);
    }
}

std::string ChildProgram::last_words() {
    boost::system::error_code nothing;
    std::array<char, 1024> room;
    while (const std::size_t size = errors_.read_some(boost::asio::buffer(room), nothing)) {
        hear({room.data(), size});
    }
    if (!line_.empty()) {
        return base::printable(line_);
    }
    return lines_.empty() ? std::string() : lines_.back();
}

}  // namespace shearwater::link
