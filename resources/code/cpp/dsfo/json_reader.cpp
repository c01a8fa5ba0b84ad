#include "json_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace dsfo {

namespace {

// Whether each byte belongs to a point that is written in its shortest form.
bool is_utf8(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = static_cast<unsigned char>(text[at++]);
        const int more = byte < 0x80 ? 0 : byte < 0xc2 ? -1 : byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
        if (more < 0 || byte > 0xf4) {
            return false;
        }
        std::uint32_t point = more == 0 ? byte : byte & (0x3fU >> more);
        for (int next = 0; next < more; ++next, ++at) {
            if (at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xc0U) != 0x80U) {
                return false;
            }
            point = (point << 6) | (static_cast<unsigned char>(text[at]) & 0x3fU);
        }
        const bool surrogate = point >= 0xd800 && point < 0xe000;
        if (surrogate || point > 0x10ffff || (more == 2 && point < 0x800) ||
            (more == 3 && point < 0x10000)) {
            return false;
        }
    }
    return true;
}

class Reader {
public:
    explicit Reader(const std::string& text) : text_(text) {}

    // Values that are still open stand on a stack, so that nothing calls itself.
    bool read(Json& whole) {
        std::vector<Json*> open{&whole};
        while (!open.empty()) {
            Json* const value = open.back();
            if (!begun_.back()) {
                if (!start(*value)) {
                    return false;
                }
                if (value->kind != Json::Kind::list && value->kind != Json::Kind::object) {
                    open.pop_back();
                    continue;
                }
                if (open.size() > Json::deepest) {
                    return false;
                }
            }
            bool ended = false;
            if (!next(*value, ended)) {
                return false;
            }
            if (ended) {
                open.pop_back();
            } else {
                value->items.emplace_back();
                open.push_back(&value->items.back());
                begun_.push_back(false);
            }
        }
        skip();
        return at_ == text_.size();
    }

private:
    const std::string& text_;
    std::size_t at_ = 0;
    std::vector<bool> begun_{false};  // for each open value: whether its first sign was read

    void skip() {
        while (at_ < text_.size() && std::strchr(" \t\r\n", text_[at_]) != nullptr &&
               text_[at_] != '\0') {
            ++at_;
        }
    }

    char peek() {
        skip();
        return at_ < text_.size() ? text_[at_] : '\0';
    }

    bool take(char wanted) {
        const bool there = peek() == wanted;
        at_ += there ? 1 : 0;
        return there;
    }

    bool take_word(const char* word) {
        const std::size_t size = std::strlen(word);
        const bool there = text_.compare(at_, size, word) == 0;
        at_ += there ? size : 0;
        return there;
    }

    // Read a value without members, or the first sign of one that has them.
    bool start(Json& value) {
        const char first = peek();
        bool good = true;
        if (first == '{' || first == '[') {
            ++at_;
            value.kind = first == '{' ? Json::Kind::object : Json::Kind::list;
            begun_.back() = true;
            return true;
        }
        if (first == '"') {
            value.kind = Json::Kind::text;
            good = read_text(value.text);
        } else if (take_word("true")) {
            value.kind = Json::Kind::flag;
            value.flag = true;
        } else if (take_word("false")) {
            value.kind = Json::Kind::flag;
        } else if (!take_word("null")) {
            value.kind = Json::Kind::number;
            good = read_number(value.number);
        }
        begun_.pop_back();
        return good;
    }

    // Go on to the next member of a list or an object, or to its end.
    bool next(Json& value, bool& ended) {
        const bool object = value.kind == Json::Kind::object;
        if (take(object ? '}' : ']')) {
            ended = true;
            begun_.pop_back();
            return true;
        }
        if (!value.items.empty() && !take(',')) {
            return false;
        }
        if (!object) {
            return true;
        }
        std::string name;
        if (peek() != '"' || !read_text(name) || !take(':') ||
            std::find(value.names.begin(), value.names.end(), name) != value.names.end()) {
            return false;
        }
        value.names.push_back(name);
        return true;
    }

    bool read_number(double& found) {
        const char* const first = text_.data() + at_;
        const char* const last = text_.data() + text_.size();
        const auto end = std::from_chars(first, last, found);
        const bool digits = first != last && (*first == '-' || (*first >= '0' && *first <= '9'));
        if (!digits || end.ec != std::errc() || *(end.ptr - 1) < '0' || *(end.ptr - 1) > '9') {
            return false;  // from_chars also reads inf and nan
        }
        at_ += static_cast<std::size_t>(end.ptr - first);
        return true;
    }

    bool read_text(std::string& found) {
        for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            const auto code = static_cast<unsigned char>(text_[at_]);
            if (code < 0x20) {
                return false;
            }
            if (code != '\\') {
                found += text_[at_];
            } else if (!read_escape(found)) {
                return false;
            }
        }
        return at_ < text_.size() && text_[at_++] == '"';
    }

    // at_ stands on the backslash, and on the last sign of the escape afterwards.
    bool read_escape(std::string& found) {
        const char sign = ++at_ < text_.size() ? text_[at_] : '\0';
        const char* const signs = "\"\\/bfnrt";
        const char* const there = sign == '\0' ? nullptr : std::strchr(signs, sign);
        if (there != nullptr) {
            found += "\"\\/\b\f\n\r\t"[there - signs];
            return true;
        }
        std::uint32_t point = 0;
        if (sign != 'u' || !read_unit(point)) {
            return false;
        }
        if (point >= 0xd800 && point < 0xdc00) {
            std::uint32_t low = 0;
            if (text_.compare(at_ + 1, 2, "\\u") != 0) {
                return false;
            }
            at_ += 2;
            if (!read_unit(low) || low < 0xdc00 || low > 0xdfff) {
                return false;
            }
            point = 0x10000 + ((point - 0xd800) << 10) + (low - 0xdc00);
        } else if (point >= 0xdc00 && point < 0xe000) {
            return false;
        }
        add(point, found);
        return true;
    }

    bool read_unit(std::uint32_t& unit) {
        if (at_ + 4 >= text_.size()) {
            return false;
        }
        const char* const first = text_.data() + at_ + 1;
        const auto end = std::from_chars(first, first + 4, unit, 16);
        at_ += 4;
        return end.ec == std::errc() && end.ptr == first + 4;
    }

    static void add(std::uint32_t point, std::string& found) {
        const auto put = [&found](std::uint32_t byte) { found += static_cast<char>(byte); };
        if (point < 0x80) {
            put(point);
        } else if (point < 0x800) {
            put(0xc0 | (point >> 6));
            put(0x80 | (point & 0x3f));
        } else if (point < 0x10000) {
            put(0xe0 | (point >> 12));
            put(0x80 | ((point >> 6) & 0x3f));
            put(0x80 | (point & 0x3f));
        } else {
            put(0xf0 | (point >> 18));
            put(0x80 | ((point >> 12) & 0x3f));
            put(0x80 | ((point >> 6) & 0x3f));
            put(0x80 | (point & 0x3f));
        }
    }
};

}  // namespace

const Json* Json::find(const std::string& name) const {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? nullptr : &items[static_cast<std::size_t>(at - names.begin())];
}

bool Json::text_of(const std::string& name, std::string& found) const {
    const Json* const there = find(name);
    if (there == nullptr || there->kind != Kind::text) {
        return false;
    }
    found = there->text;
    return true;
}

bool Json::number_of(const std::string& name, double& found) const {
    const Json* const there = find(name);
    if (there == nullptr || there->kind != Kind::number) {
        return false;
    }
    found = there->number;
    return true;
}

bool Json::flag_of(const std::string& name, bool& found) const {
    const Json* const there = find(name);
    if (there == nullptr || there->kind != Kind::flag) {
        return false;
    }
    found = there->flag;
    return true;
}

const std::vector<Json>& Json::list_of(const std::string& name) const {
    static const std::vector<Json> none;
    const Json* const there = find(name);
    return there != nullptr && there->kind == Kind::list ? there->items : none;
}

bool read_json(const std::string& text, Json& found) {
    return is_utf8(text) && Reader(text).read(found);
}

}  // namespace dsfo
