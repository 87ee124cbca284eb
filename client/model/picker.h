#pragma once
// Asks the server what is to be seen at a point of the picture.

#include <optional>

#include "client/model/status.h"
#include "common/view/transfer_function.h"
#include "protocol/wire/convert_pick.h"

namespace shearwater::model {

// What for.
enum class Purpose {
    read,   // where it is and which value it has
    pivot,  // to turn the view about it
};

struct Picked {
    Purpose purpose = Purpose::read;
    view::Vec2 at;  // of the picture
    std::optional<view::RayHit> hit;
    double value = 0;  // physical; not a number where there is none
    bool incomplete = false;
};

class Picker {
  public:
    // The message to send; only the newest is answered.
    wire::Message ask(Purpose purpose, wire::PickRequest request);
    // What a server answers, if it is to the newest question, in a cube that has been described.
    wire::Parsed<std::optional<Picked>> answer(const wire::pb::Picked& picked,
                                               const std::optional<Cube>& cube);
    // The link is down: there will be no answer.
    void give_up() { asked_.reset(); }

  private:
    struct Asked {
        std::uint64_t revision;
        Purpose purpose;
        view::Vec2 at;
    };
    std::optional<Asked> asked_;
    std::uint64_t revision_ = 0;
};

}  // namespace shearwater::model
