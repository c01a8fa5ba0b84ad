#include "log.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>

namespace dsfo {

namespace {

constexpr std::array<std::uint32_t, 64> rounds{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

std::uint32_t turned(std::uint32_t value, int bits) {
    return (value >> bits) | (value << (32 - bits));
}

std::string escaped(std::uint32_t unit) {
    const char* digits = "0123456789abcdef";
    std::string found = "\\u";
    for (int shift = 12; shift >= 0; shift -= 4) {
        found += digits[(unit >> shift) & 15U];
    }
    return found;
}

}  // namespace

void Sha256::block(const unsigned char* bytes) {
    std::array<std::uint32_t, 64> word{};
    for (std::size_t at = 0; at < 16; ++at) {
        word[at] = (static_cast<std::uint32_t>(bytes[4 * at]) << 24) |
                   (static_cast<std::uint32_t>(bytes[4 * at + 1]) << 16) |
                   (static_cast<std::uint32_t>(bytes[4 * at + 2]) << 8) |
                   static_cast<std::uint32_t>(bytes[4 * at + 3]);
    }
    for (std::size_t at = 16; at < 64; ++at) {
        const std::uint32_t low = turned(word[at - 15], 7) ^ turned(word[at - 15], 18) ^
                                  (word[at - 15] >> 3);
        const std::uint32_t high = turned(word[at - 2], 17) ^ turned(word[at - 2], 19) ^
                                   (word[at - 2] >> 10);
        word[at] = word[at - 16] + low + word[at - 7] + high;
    }
    auto [a, b, c, d, e, f, g, h] = state_;
    for (std::size_t at = 0; at < 64; ++at) {
        const std::uint32_t high = turned(e, 6) ^ turned(e, 11) ^ turned(e, 25);
        const std::uint32_t one = h + high + ((e & f) ^ (~e & g)) + rounds[at] + word[at];
        const std::uint32_t low = turned(a, 2) ^ turned(a, 13) ^ turned(a, 22);
        const std::uint32_t two = low + ((a & b) ^ (a & c) ^ (b & c));
        h = g;
        g = f;
        f = e;
        e = d + one;
        d = c;
        c = b;
        b = a;
        a = one + two;
    }
    const std::array<std::uint32_t, 8> more{a, b, c, d, e, f, g, h};
    for (std::size_t at = 0; at < 8; ++at) {
        state_[at] += more[at];
    }
}

void Sha256::add(const std::string& bytes) {
    length_ += bytes.size();
    rest_ += bytes;
    std::size_t at = 0;
    for (; rest_.size() - at >= 64; at += 64) {
        block(reinterpret_cast<const unsigned char*>(rest_.data()) + at);
    }
    rest_.erase(0, at);
}

std::string Sha256::hex() const {
    Sha256 last = *this;
    std::string end(1, '\x80');
    end.append((119 - last.rest_.size()) % 64, '\0');
    for (int shift = 56; shift >= 0; shift -= 8) {
        end += static_cast<char>(((length_ * 8) >> shift) & 255U);
    }
    last.add(end);
    std::string found;
    for (const std::uint32_t word : last.state_) {
        found += escaped(word >> 16).substr(2) + escaped(word & 0xffffU).substr(2);
    }
    return found;
}

std::string json_text(const std::string& text) {
    std::string found = "\"";
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = static_cast<unsigned char>(text[at]);
        const int more = byte < 0x80 ? 0 : byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
        std::uint32_t point = more == 0 ? byte : byte & (0x3fU >> more);
        for (int next = 0; next < more; ++next) {
            const std::size_t other = at + 1 + static_cast<std::size_t>(next);
            const char low = other < text.size() ? text[other] : '\0';
            point = (point << 6) | (static_cast<unsigned char>(low) & 0x3fU);
        }
        at += 1 + static_cast<std::size_t>(more);
        if (point == '"' || point == '\\') {
            found += std::string("\\") + static_cast<char>(point);
        } else if (point >= 0x20 && point < 0x7f) {
            found += static_cast<char>(point);
        } else if (point < 0x10000) {
            found += escaped(point);
        } else {
            found += escaped(0xd800U + ((point - 0x10000U) >> 10));
            found += escaped(0xdc00U + ((point - 0x10000U) & 0x3ffU));
        }
    }
    return found + "\"";
}

std::string json_number(double number) {
    std::array<char, 40> text{};
    const double shown = std::nearbyint(number * 1e6) / 1e6;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), shown);
    std::string found(text.data(), end.ptr);
    const bool whole = found.find_first_of(".e") == std::string::npos;
    return whole ? found + ".0" : found;
}

std::string plain_number(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", number);
    return text.data();
}

std::string json_list(const std::vector<std::string>& texts) {
    std::string found = "[";
    for (std::size_t at = 0; at < texts.size(); ++at) {
        found += (at ? "," : "") + json_text(texts[at]);
    }
    return found + "]";
}

std::string json_map(const std::vector<std::pair<std::string, std::string>>& texts) {
    Object found;
    for (const auto& [name, value] : texts) {
        found.text(name, value);
    }
    return found.str();
}

Object& Object::text(const std::string& name, const std::string& value) {
    return raw(name, json_text(value));
}

Object& Object::number(const std::string& name, double value) {
    return raw(name, json_number(value));
}

Object& Object::count(const std::string& name, long value) {
    return raw(name, std::to_string(value));
}

Object& Object::raw(const std::string& name, const std::string& json) {
    members_ += (members_.empty() ? "" : ",") + json_text(name) + ":" + json;
    return *this;
}

RunLog::RunLog(const std::string& path, const std::string& header, std::string& failed) {
    std::error_code error;
    const auto kind = std::filesystem::symlink_status(path, error).type();
    const bool fresh = kind == std::filesystem::file_type::not_found;
    const bool plain = kind == std::filesystem::file_type::regular;
    if (!fresh && (!plain || std::filesystem::file_size(path, error) > 0)) {
        failed = path + " is not empty, or no ordinary file";
        return;
    }
    file_.open(path, std::ios::binary | std::ios::app);
    linked(header);
    if (!file_.good()) {
        failed = "the run log cannot be written";
    }
}

void RunLog::write(const std::string& event) {
    linked(event);
    ++count_;
}

void RunLog::finish() {
    Object head;
    head.count("count", count_).text("hash", hash_.hex());
    file_ << Object().raw("head", head.str()).str() << "\n" << std::flush;
    file_.close();
}

void RunLog::linked(const std::string& line) {
    const std::string before = line.substr(0, line.size() - 1) + ",\"chain\":\"";
    hash_.add(before);
    const std::string after = hash_.hex() + "\"}\n";
    hash_.add(after);
    file_ << before << after << std::flush;
}

std::string now() {
    const auto moment = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(moment);
    const auto since = moment.time_since_epoch();
    const auto milli = std::chrono::duration_cast<std::chrono::milliseconds>(since).count() % 1000;
    std::array<char, 40> text{};
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
    const std::string digits = std::to_string(1000 + milli).substr(1);
    return std::string(text.data()) + "." + digits + "+00:00";
}

}  // namespace dsfo
