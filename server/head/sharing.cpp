#include "server/head/sharing.h"

#include <algorithm>
#include <utility>

namespace shearwater::head {

bool Sharing::given(std::span<const std::uint64_t> numbers) {
    bool all = true;
    for (const std::uint64_t number : numbers) {
        if (given_.contains(number)) {
            continue;
        }
        all = false;
        const bool is_being_given = giving_ && giving_->number == number;
        if (!is_being_given && std::ranges::find(to_give_, number) == to_give_.end()) {
            to_give_.push_back(number);
        }
    }
    return all;
}

void Sharing::keep(std::span<const std::uint64_t> numbers) {
    const auto is_other = [&](std::uint64_t number) {
        return std::ranges::find(numbers, number) == numbers.end();
    };
    std::erase_if(given_, is_other);
    std::erase_if(to_give_, is_other);
    if (giving_ && is_other(giving_->number)) {
        giving_.reset();
    }
}

std::optional<Sharing::Piece> Sharing::take_piece(wire::Time now) {
    if (not_before_ && now < *not_before_) {
        return std::nullopt;
    }
    if (!giving_ && !to_give_.empty()) {
        giving_ = Giving{.number = to_give_.front()};
        to_give_.pop_front();
    }
    if (!giving_ || giving_->request != 0) {
        return std::nullopt;
    }
    giving_->request = ++last_request_;
    return Piece{giving_->request, giving_->number, giving_->next_direction};
}

void Sharing::sent(std::uint64_t request, int directions, int all, wire::Time now) {
    if (!giving_ || giving_->request != request) {
        return;
    }
    if (directions == 0) {
        give_up(now);
        return;
    }
    giving_->next_direction += directions;
    giving_->all = giving_->next_direction >= all;
}

std::uint64_t Sharing::begin_look(std::uint64_t frame, std::vector<std::uint64_t> numbers) {
    looks_[++last_request_] = {frame, std::move(numbers)};
    return last_request_;
}

std::optional<std::uint64_t> Sharing::replied(const wire::Reply& reply, wire::Time now) {
    if (const auto look = looks_.extract(reply.request)) {
        if (reply.incomplete) {
            for (const std::uint64_t number : look.mapped().numbers) {
                given_.erase(number);
            }
            not_before_ = now + pause;
        }
        return look.mapped().frame;
    }
    if (!giving_ || giving_->request != reply.request) {
        return std::nullopt;  // it is no longer wanted
    }
    if (reply.incomplete) {
        give_up(now);
    } else if (giving_->all) {
        given_.insert(giving_->number);
        giving_.reset();
    } else {
        giving_->request = 0;
    }
    return std::nullopt;
}

// A view that needs it puts it among those to be given again.
void Sharing::give_up(wire::Time now) {
    giving_.reset();
    not_before_ = now + pause;
}

}  // namespace shearwater::head
