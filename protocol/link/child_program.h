#pragma once
// A program whose standard input and output are a stream to us: ssh, as a rule, with a server at its other
// end. Nothing listens for it.

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/result.h"

namespace shearwater::link {

class ChildProgram : public std::enable_shared_from_this<ChildProgram> {
  public:
    // Starts command[0], looked for on the path. Not found: there is no such program.
    static base::Result<std::shared_ptr<ChildProgram>> start(boost::asio::io_context& io,
                                                             const std::vector<std::string>& command);
    // Ends it, when it has not ended by itself soon after its stream was closed.
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    // The stream's descriptor, once: whoever takes it closes it.
    int take_stream() { return std::exchange(stream_, -1); }
    // The last line it wrote to standard error, printable; empty when there is none.
    std::string last_words();
    // From now on all its lines go to our standard error, those of before too. (Until then they may tell why
    // it failed, which the caller says.)
    void speak_out();

  private:
    ChildProgram(boost::asio::io_context& io, int pid, int stream, int errors);
    void listen();
    void hear(std::string_view text);

    int pid_;
    int stream_;
    boost::asio::posix::stream_descriptor errors_;
    std::array<char, 1024> room_{};
    std::deque<std::string> lines_;  // ended ones, the newest last
    std::string line_;
    bool speaks_out_ = false;
};

}  // namespace shearwater::link
