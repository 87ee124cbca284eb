#pragma once
// JSON as the reports are written in: objects on one line.

#include <ostream>
#include <string>

namespace shearwater::deploy {

// A string literal, free of what is not printable.
std::string quoted(const std::string& text);

// Writes one object, member by member.
class JsonObject {
  public:
    explicit JsonObject(std::ostream& out) : out_(out) { out_ << '{'; }
    template <class T>
    JsonObject& add(const std::string& key, const T& value) {
        begin(key) << value;
        return *this;
    }
    std::ostream& begin(const std::string& key) {
        out_ << (first_ ? "" : ", ") << quoted(key) << ": ";
        first_ = false;
        return out_;
    }
    void end() { out_ << '}'; }

  private:
    std::ostream& out_;
    bool first_ = true;
};

}  // namespace shearwater::deploy
