#pragma once
// Looking at pictures shared over the renderers: which functions all of them have been given, piece by piece
// in the background, and which looks they have been asked for.

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "protocol/wire/convert_look.h"
#include "protocol/wire/events.h"

namespace shearwater::head {

class Sharing {
  public:
    // Before what somebody could not take is given once more.
    static constexpr std::chrono::seconds pause{5};

    // Whether all renderers have been given all of these functions, by their numbers. Those that they have
    // not are given from now on, one after the other.
    bool given(std::span<const std::uint64_t> numbers);
    // Renderers forget all but these.
    void keep(std::span<const std::uint64_t> numbers);

    // The piece of a function's table from a direction on, that is to be sent as a request.
    struct Piece {
        std::uint64_t request;
        std::uint64_t number;
        int first_direction;
    };
    // One at a time: the next when all have taken the last.
    std::optional<Piece> take_piece(wire::Time now);
    // It is being sent, and has so many directions of all; none where there is no such table any more.
    void sent(std::uint64_t request, int directions, int all, wire::Time now);

    // The number of a request to look for a frame, by functions that have been given.
    std::uint64_t begin_look(std::uint64_t frame, std::vector<std::uint64_t> numbers);
    // What all renderers together reply to a request. The frame, if that was to look for one; where the reply
    // is incomplete, the functions are given anew.
    std::optional<std::uint64_t> replied(const wire::Reply& reply, wire::Time now);

  private:
    struct Giving {
        std::uint64_t number;
        int next_direction = 0;
        std::uint64_t request = 0;  // that is to be replied to; 0: none
        bool all = false;           // nothing follows it
    };
    struct Asked {
        std::uint64_t frame;
        std::vector<std::uint64_t> numbers;
    };

    void give_up(wire::Time now);

    std::set<std::uint64_t> given_;
    std::deque<std::uint64_t> to_give_;
    std::optional<Giving> giving_;
    std::map<std::uint64_t, Asked> looks_;  // by request
    std::uint64_t last_request_ = 0;
    std::optional<wire::Time> not_before_;
};

}  // namespace shearwater::head
