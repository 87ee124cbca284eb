#pragma once
// CLI11's names. Its header is long to compile: whoever declares options includes it, and nobody else.

namespace CLI {

class App;
class Option;

}  // namespace CLI
