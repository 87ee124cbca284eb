#include "tests/support/desktop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>

namespace shearwater::test {

namespace {

using namespace std::chrono_literals;

struct Close {
    void operator()(::Display* display) const { XCloseDisplay(display); }
};
using Connection = std::unique_ptr<::Display, Close>;

using Words = std::array<long, 5>;

void send(::Display* display, Window to, const char* message, const Words& words) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.display = display;
    event.xclient.window = to;
    event.xclient.message_type = XInternAtom(display, message, False);
    event.xclient.format = 32;
    std::ranges::copy(words, event.xclient.data.l);
    XSendEvent(display, to, False, NoEventMask, &event);
    XFlush(display);
}

// Of those on the display's root.
std::optional<Window> window_titled(::Display* display, const std::string& words) {
    Window root = None, parent = None;
    Window* children = nullptr;
    unsigned count = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
    std::optional<Window> found;
    for (unsigned n = 0; n < count; ++n) {
        char* name = nullptr;
        if (XFetchName(display, children[n], &name) != 0 && name != nullptr) {
            if (std::string(name).find(words) != std::string::npos) {
                found = children[n];
            }
            XFree(name);
        }
    }
    if (children != nullptr) {
        XFree(children);
    }
    return found;
}

class Source {
  public:
    Source(::Display* display, const std::string& path)
        : display_(display),
          window_(XCreateSimpleWindow(display, DefaultRootWindow(display), -10, -10, 1, 1, 0, 0, 0)),
          list_("file://" + path + "\r\n") {}
    ~Source() { XDestroyWindow(display_, window_); }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    std::string drop_at(int x, int y) {
        const std::optional<Window> found = aware_at(x, y);
        if (!found) {
            return "no window there takes drops";
        }
        target_ = *found;
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, CurrentTime);
        const auto own = static_cast<long>(window_);
        send(display_, target_, "XdndEnter", {own, 5L << 24, static_cast<long>(atom("text/uri-list"))});
        send(display_, target_, "XdndPosition",
             {own, 0, (static_cast<long>(x) << 16) | y, CurrentTime,
              static_cast<long>(atom("XdndActionCopy"))});
        const auto status = answer("XdndStatus");
        if (!status) {
            return "the window never said whether it takes the file";
        }
        if ((status->data.l[1] & 1) == 0) {
            return "the window does not take it";
        }
        send(display_, target_, "XdndDrop", {own, 0, CurrentTime});
        return answer("XdndFinished") ? "" : "the window never took the file";
    }

  private:
    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    // The window at a place that the protocol's property is set on, from the root downwards.
    std::optional<Window> aware_at(int x, int y) const {
        Window at = DefaultRootWindow(display_);
        while (at != None) {
            Atom type = None;
            int format = 0;
            unsigned long items = 0, rest = 0;
            unsigned char* data = nullptr;
            XGetWindowProperty(display_, at, atom("XdndAware"), 0, 1, False, AnyPropertyType, &type, &format,
                               &items, &rest, &data);
            if (data != nullptr) {
                XFree(data);
            }
            if (type != None) {
                return at;
            }
            int ignored_x = 0, ignored_y = 0;
            Window child = None;
            XTranslateCoordinates(display_, DefaultRootWindow(display_), at, x, y, &ignored_x, &ignored_y,
                                  &child);
            at = child;
        }
        return std::nullopt;
    }

    // A message of the window's; until it comes the list of files is given to whoever asks.
    std::optional<XClientMessageEvent> answer(const char* message) {
        const auto end = std::chrono::steady_clock::now() + 30s;
        while (std::chrono::steady_clock::now() < end) {
            if (XPending(display_) == 0) {
                pollfd ready{ConnectionNumber(display_), POLLIN, 0};
                poll(&ready, 1, 100);
                continue;
            }
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) {
                give(event.xselectionrequest);
            } else if (event.type == ClientMessage && event.xclient.message_type == atom(message)) {
                return event.xclient;
            }
        }
        return std::nullopt;
    }

    void give(const XSelectionRequestEvent& request) {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(list_.data()), static_cast<int>(list_.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = request.requestor;
        event.xselection.selection = request.selection;
        event.xselection.target = request.target;
        event.xselection.property = request.property;
        event.xselection.time = request.time;
        XSendEvent(display_, request.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    ::Display* const display_;
    const Window window_;
    const std::string list_;
    Window target_ = None;
};

}  // namespace

std::string drop_file(const std::string& display, const std::string& path, int x, int y) {
    const Connection connection(XOpenDisplay(display.c_str()));
    return connection ? Source(connection.get(), path).drop_at(x, y) : "there is no display " + display;
}

std::string ask_to_close(const std::string& display, const std::string& title) {
    const Connection connection(XOpenDisplay(display.c_str()));
    if (!connection) {
        return "there is no display " + display;
    }
    const auto window = window_titled(connection.get(), title);
    if (!window) {
        return "there is no window " + title;
    }
    const Atom close = XInternAtom(connection.get(), "WM_DELETE_WINDOW", False);
    send(connection.get(), *window, "WM_PROTOCOLS", {static_cast<long>(close), CurrentTime});
    return "";
}

}  // namespace shearwater::test
