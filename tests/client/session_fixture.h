#pragma once
// A session whose server is the test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "client/model/session.h"
#include "common/image/rle.h"
#include "protocol/wire/convert.h"

namespace shearwater::model {

namespace pb = wire::pb;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A session with the other end in the test's hands and a clock that it sets.
class SessionTest : public testing::Test {
  protected:
    SessionTest() { wish_.size = {32, 16}; }

    void start() {
        session_.start(now_);
        take();
    }
    void connect() {
        start();
        up();
        receive(description());
        take();
    }
    void up() { event(wire::LinkUp{link(), pb::ROLE_CLIENT, "server", "127.0.0.1"}); }
    void down(pb::Reason reason, std::string text = "") {
        event(wire::LinkDown{link(), reason, std::move(text)});
    }
    void event(const wire::NetEvent& e) {
        session_.handle(e, now_);
        take();
    }
    template <class T>
    void receive(T body, std::vector<std::byte> payload = {}) {
        event(wire::Received{link(), wire::message(std::move(body), std::move(payload))});
    }
    void want(Change change = Change::single) {
        session_.want(wish_, change, now_);
        take();
    }
    void turn(Change change = Change::single) {
        wish_.viewpoint.orbit.azimuth += 1;
        want(change);
    }
    // Lets the time pass in the steps a hub ticks in.
    void pass(std::chrono::milliseconds time) {
        for (; time > 0ms; time -= 50ms) {
            now_ += std::min(time, 50ms);
            event(wire::Tick{});
        }
    }

    // Sorts what the session did.
    void take() {
        for (const wire::NetEffect& effect : session_.take_effects()) {
            if (const auto* dial = std::get_if<wire::Dial>(&effect)) {
                dials_.push_back(*dial);
            } else if (const auto* close = std::get_if<wire::CloseLink>(&effect)) {
                EXPECT_EQ(close->link, link());
                closes_.push_back(*close);
            } else {
                const auto& send = std::get<wire::Send>(effect);
                EXPECT_EQ(send.link, link());
                if (const auto* view = std::get_if<pb::SetView>(&send.message.body)) {
                    auto parsed = wire::view_from(*view);
                    ASSERT_TRUE(parsed) << parsed.error().text;
                    views_.push_back(std::move(*parsed));
                } else if (const auto* pick = std::get_if<pb::Pick>(&send.message.body)) {
                    picks_.push_back(*pick);
                } else {
                    shown_.push_back(std::get<pb::FrameShown>(send.message.body).number());
                }
            }
        }
    }

    wire::LinkId link() const { return dials_.back().link; }
    Status status() const { return session_.status(now_); }

    static pb::CubeDescription description() {
        pb::CubeDescription d;
        d.set_name("cube.fits");
        *d.mutable_lattice() = wire::to_wire(view::Lattice{.n = {9, 8, 7}, .spacing = {1, 1, 1}});
        *d.mutable_mapping() = wire::to_wire(volume::Mapping{});
        return d;
    }
    static image::Image<image::Rgba8> picture(int width, int height) {
        image::Image<image::Rgba8> image(width, height);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            image.pixels()[i] = {static_cast<std::uint8_t>(i / 3), 7, 9, 255};
        }
        return image;
    }
    static std::vector<std::byte> code(const image::Image<image::Rgba8>& image) {
        std::vector<std::byte> bytes(image::rle_bound(image.pixels().size()));
        bytes.resize(image::encode_rle(image.pixels(), bytes));
        return bytes;
    }
    pb::Frame frame(std::uint64_t revision) {
        pb::Frame f;
        f.set_number(++last_number_);
        f.set_revision(revision);
        f.set_width(32);
        f.set_height(16);
        return f;
    }
    void answer(std::uint64_t revision) { receive(frame(revision), code(picture(32, 16))); }
    static pb::TreeState tree(std::initializer_list<pb::Phase> renderers) {
        pb::TreeState state;
        auto* head = state.add_nodes();
        head->set_parent(-1);
        head->set_phase(pb::PHASE_READY);
        *head->mutable_box() = wire::to_wire(volume::whole({9, 8, 7}));
        std::uint32_t place = 0;
        bool ready = true;
        for (const pb::Phase phase : renderers) {
            auto* node = state.add_nodes();
            node->set_place(++place);
            node->set_parent(0);
            node->set_role(pb::ROLE_RENDERER);
            node->set_phase(phase);
            *node->mutable_box() = wire::to_wire(volume::whole({9, 8, 7}));
            ready = ready && phase == pb::PHASE_READY;
        }
        state.set_ready(ready);
        return state;
    }
    void expect_closed(pb::Reason reason, const std::string& words) {
        ASSERT_THAT(closes_, SizeIs(1));
        EXPECT_EQ(closes_[0].reason, reason) << closes_[0].text;
        EXPECT_THAT(closes_[0].text, HasSubstr(words));
        EXPECT_EQ(status().connection, Connection::waiting);
        EXPECT_THAT(status().words, HasSubstr(words));
        EXPECT_FALSE(session_.take_picture());
    }

    wire::Time now_ = wire::Time{} + 1000s;
    Session session_{wire::Address{"host", 4000}};
    Wish wish_;
    std::uint64_t last_number_ = 0;
    std::vector<wire::Dial> dials_;
    std::vector<wire::CloseLink> closes_;
    std::vector<wire::View> views_;
    std::vector<std::uint64_t> shown_;
    std::vector<pb::Pick> picks_;
};

}  // namespace shearwater::model
