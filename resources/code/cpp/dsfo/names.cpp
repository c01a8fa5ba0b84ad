#include "names.hpp"

#include <algorithm>
#include <cstdint>
#include <set>

namespace dsfo {

namespace {

// The points of a text in UTF-8, which has been checked.
std::vector<std::uint32_t> points_of(const std::string& text) {
    std::vector<std::uint32_t> found;
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = static_cast<unsigned char>(text[at++]);
        int more = byte < 0x80 ? 0 : byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
        std::uint32_t point = more == 0 ? byte : byte & (0x3fU >> more);
        for (; more > 0 && at < text.size(); --more) {
            point = (point << 6) | (static_cast<unsigned char>(text[at++]) & 0x3fU);
        }
        found.push_back(point);
    }
    return found;
}

bool is_invisible(std::uint32_t point) {
    const auto in = [point](std::uint32_t first, std::uint32_t last) {
        return point >= first && point <= last;
    };
    return point < 0x20 || in(0x7f, 0x9f) || point == 0xad || point == 0x34f || point == 0x61c ||
           in(0x115f, 0x1160) || in(0x17b4, 0x17b5) || in(0x180b, 0x180f) || in(0x200b, 0x200f) ||
           in(0x202a, 0x202e) || in(0x2060, 0x206f) || point == 0x2800 || in(0xfe00, 0xfe0f) ||
           point == 0xfeff || in(0xfff9, 0xfffb) || in(0xe0000, 0xe0fff);
}

bool is_space(std::uint32_t point) {
    return point == 0x20 || (point >= 0x09 && point <= 0x0d) || point == 0xa0 ||
           (point >= 0x2000 && point <= 0x200a) || point == 0x2028 || point == 0x2029 ||
           point == 0x202f || point == 0x205f || point == 0x3000;
}

bool is_accent(std::uint32_t point) { return point >= 0x300 && point <= 0x36f; }

// The letters without case and accents of U+00C0 to U+017F, in order; "_" stands for a sign.
const char* const latin =
    "a a a a a a aec e e e e i i i i d n o o o o o _ o u u u u y thss"
    "a a a a a a aec e e e e i i i i d n o o o o o _ o u u u u y thy "
    "a a a a a a c c c c c c c c d d d d e e e e e e e e e e g g g g "
    "g g g g h h h h i i i i i i i i i i ijijj j k k k l l l l l l l "
    "l l l n n n n n n n n n o o o o o o oeoer r r r r r s s s s s s "
    "s s t t t t t t u u u u u u u u u u u u w w y y y z z z z z z s ";

std::string latin_letter(std::uint32_t point) {
    std::string found(latin + 2 * (point - 0xc0), 2);
    found.erase(std::remove(found.begin(), found.end(), ' '), found.end());
    return found;
}

// Greek and Cyrillic letters without case. Accented ones stay as they are written.
std::uint32_t lower(std::uint32_t point) {
    if ((point >= 0x391 && point <= 0x3a9) || (point >= 0x410 && point <= 0x42f)) {
        return point + 0x20;
    }
    if (point >= 0x400 && point <= 0x40f) {
        return point + 0x50;
    }
    return point == 0x3c2 ? 0x3c3 : point;
}

}  // namespace

std::string same_name(const std::string& text, bool& known) {
    std::string found;
    known = true;
    for (const std::uint32_t point : points_of(text)) {
        if (is_space(point) || is_invisible(point) || is_accent(point)) {
            continue;
        }
        if (point < 0x80) {
            const auto sign = static_cast<char>(point);
            found += sign >= 'A' && sign <= 'Z' ? static_cast<char>(sign + 32) : sign;
        } else if (point >= 0xc0 && point <= 0x17f) {
            found += latin_letter(point);
        } else {
            known = known && ((point >= 0x391 && point <= 0x3c9) ||
                              (point >= 0x400 && point <= 0x45f));
            found += "+" + std::to_string(lower(point));
        }
    }
    return found;
}

std::string same_name(const std::string& text) {
    bool known = true;
    return same_name(text, known);
}

bool is_printable(const std::string& text) {
    const std::vector<std::uint32_t> points = points_of(text);
    const bool plain = std::all_of(points.begin(), points.end(), [](std::uint32_t point) {
        return point == 0x20 || !(is_space(point) || is_invisible(point));
    });
    return plain && text.find_first_not_of(' ') != std::string::npos;
}

bool seated(
    const std::vector<std::string>& wanted, const std::vector<std::string>& given,
    const std::string& escalation) {
    const std::string also = same_name(escalation);
    std::set<std::set<std::size_t>> left{{}};  // the taken seats, for each order of seating
    for (const std::string& role : given) {
        const std::string person = same_name(role);
        std::set<std::set<std::size_t>> next;
        for (const std::set<std::size_t>& taken : left) {
            for (std::size_t seat = 0; seat < wanted.size(); ++seat) {
                const std::string asked = same_name(wanted[seat]);
                const bool fits = asked.empty() || asked == person;
                if (!taken.count(seat) && (fits || (!also.empty() && person == also))) {
                    std::set<std::size_t> more = taken;
                    more.insert(seat);
                    next.insert(more);
                }
            }
        }
        left = next;
    }
    return !left.empty();
}

}  // namespace dsfo
