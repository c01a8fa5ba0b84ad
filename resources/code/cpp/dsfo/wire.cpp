#include "wire.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>

#include "log.hpp"

namespace dsfo {

namespace {

constexpr std::size_t largest = 4U << 20U;  // bytes of the largest frame
constexpr double stop_limit = 0.5;  // seconds in which a stop is to be acknowledged
constexpr long long look = 50;  // milliseconds after which a person's wish to stop is looked for

long long now_ms() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
}

long long after(double seconds) { return now_ms() + static_cast<long long>(seconds * 1000.0); }

int connected(int family, const sockaddr* place, socklen_t size) {
    const int end = socket(family, SOCK_STREAM, 0);
    if (end >= 0 && ::connect(end, place, size) != 0) {
        ::close(end);
        return -1;
    }
    return end;
}

}  // namespace

Wire::~Wire() {
    if (end_ >= 0) {
        ::close(end_);
    }
}

std::string Wire::connect(const std::string& address) {
    if (address.rfind("unix:", 0) == 0) {
        const std::string path = address.substr(5);
        sockaddr_un place{};
        place.sun_family = AF_UNIX;
        if (path.empty() || path.size() >= sizeof place.sun_path) {
            return address + " names no socket: its path is empty or too long";
        }
        path.copy(place.sun_path, path.size());
        end_ = connected(AF_UNIX, reinterpret_cast<const sockaddr*>(&place), sizeof place);
    } else {
        const std::size_t colon = address.rfind(':');
        const std::string host = address.substr(0, colon);
        int port = 0;
        if (colon != std::string::npos) {
            const char* const last = address.data() + address.size();
            const auto end = std::from_chars(address.data() + colon + 1, last, port);
            port = end.ptr == last ? port : 0;
        }
        if (port < 1 || port > 65535) {
            return address + " is no address: it is unix:PATH or 127.0.0.1:PORT";
        }
        if (host == "[::1]") {
            sockaddr_in6 place{};
            place.sin6_family = AF_INET6;
            place.sin6_addr = in6addr_loopback;
            place.sin6_port = htons(static_cast<std::uint16_t>(port));
            end_ = connected(AF_INET6, reinterpret_cast<const sockaddr*>(&place), sizeof place);
        } else if (host == "127.0.0.1" || host == "localhost") {
            sockaddr_in place{};
            place.sin_family = AF_INET;
            place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
            place.sin_port = htons(static_cast<std::uint16_t>(port));
            end_ = connected(AF_INET, reinterpret_cast<const sockaddr*>(&place), sizeof place);
        } else {
            return address + " is beyond this computer, and the connection is not encrypted";
        }
        if (end_ >= 0) {
            const int on = 1;
            setsockopt(end_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        }
    }
    if (end_ < 0 || fcntl(end_, F_SETFL, O_NONBLOCK) != 0) {
        return "nobody listens at " + address;
    }
    return "";
}

std::string Wire::ask(
    const std::string& verb, const std::string& members, double limit, Json& answer) {
    interrupted_ = declined_ = false;
    if (!bytes_.empty()) {
        return "it said something that nobody asked";
    }
    const long long until = after(limit);
    std::string why = send(verb, members, until);
    while (why.empty()) {
        const Came came = receive(std::min(until, now_ms() + look), answer, why);
        if (came == Came::frame) {
            break;
        }
        if (came == Came::nothing && hurry_()) {
            interrupted_ = true;
            return "";
        }
        if (came == Came::nothing && now_ms() >= until) {
            why = "it did not answer for " + std::to_string(static_cast<int>(limit)) + " s";
        }
    }
    if (!why.empty()) {
        return why;
    }
    double told = 0.0;
    std::string word;
    if (!answer.number_of("n", told) || told != static_cast<double>(number_)) {
        return "it answered another question";
    }
    if (!answer.text_of("answer", word) || (word != verb && word != "refused")) {
        return "it answered something else than " + verb;
    }
    declined_ = word == "refused";
    return "";
}

bool Wire::stop() {
    const long long until = after(stop_limit);
    std::string why = send("stop", "\"mode\":\"hold\"", until);
    while (why.empty() && now_ms() < until) {
        Json frame;
        double told = 0.0;
        std::string word;
        if (receive(until, frame, why) == Came::frame && frame.number_of("n", told) &&
            told == static_cast<double>(number_)) {
            return frame.text_of("answer", word) && word == "stop";
        }
    }
    return false;
}

void Wire::close() {
    if (end_ >= 0) {
        send("close", "", now_ms());
        ::close(end_);
        end_ = -1;
    }
}

std::string Wire::send(
    const std::string& verb, const std::string& members, long long until) {
    if (end_ < 0) {
        return "the connection is closed";
    }
    Object said;
    said.count("n", ++number_).text("ask", verb);
    if (!session_.empty()) {
        said.text("session", session_);
    }
    std::string text = said.str();
    if (!members.empty()) {
        text.insert(text.size() - 1, "," + members);
    }
    const std::uint32_t size = htonl(static_cast<std::uint32_t>(text.size()));
    std::string frame(4, '\0');
    std::memcpy(&frame[0], &size, 4);
    frame += text;
    for (std::size_t at = 0; at < frame.size();) {
        const ssize_t sent = ::send(end_, &frame[at], frame.size() - at, MSG_NOSIGNAL);
        if (sent > 0) {
            at += static_cast<std::size_t>(sent);
        } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
            return "the connection is lost";
        } else if (!wait(POLLOUT, until) && now_ms() >= until) {
            return "it does not read what is sent";
        }
    }
    return "";
}

bool Wire::wait(short event, long long until) const {
    pollfd waited{end_, event, 0};
    const long long left = std::max(0LL, until - now_ms());
    return poll(&waited, 1, static_cast<int>(left)) > 0;
}

Wire::Came Wire::receive(long long until, Json& frame, std::string& why) {
    for (;;) {
        if (bytes_.size() >= 4) {
            std::uint32_t size = 0;
            std::memcpy(&size, bytes_.data(), 4);
            size = ntohl(size);
            if (size == 0 || size > largest) {
                why = "it sent a frame of a wrong length";
                return Came::lost;
            }
            if (bytes_.size() >= 4U + size) {
                frame = Json();
                const bool read = read_json(bytes_.substr(4, size), frame);
                bytes_.erase(0, 4U + size);
                if (!read || frame.kind != Json::Kind::object) {
                    why = "it sent a frame that is no JSON object";
                    return Came::lost;
                }
                return Came::frame;
            }
        }
        std::array<char, 65536> piece{};
        const ssize_t came = recv(end_, piece.data(), piece.size(), 0);
        if (came > 0) {
            bytes_.append(piece.data(), static_cast<std::size_t>(came));
        } else if (came == 0) {
            why = "the connection was closed";
            return Came::lost;
        } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
            why = "the connection is lost";
            return Came::lost;
        } else if (!wait(POLLIN, until)) {
            return Came::nothing;
        }
    }
}

}  // namespace dsfo
