// Reads JSON that comes from outside: one value in UTF-8, no key twice, no deeper than `deepest`.
#pragma once

#include <string>
#include <vector>

namespace dsfo {

struct Json {
    enum class Kind { null, flag, number, text, list, object };

    static constexpr std::size_t deepest = 16;

    Kind kind = Kind::null;
    bool flag = false;
    double number = 0.0;
    std::string text;
    std::vector<std::string> names;  // of the items of an object
    std::vector<Json> items;

    const Json* find(const std::string& name) const;  // nullptr if there is none

    // Each is false if there is no such member, or if it is of another kind.
    bool text_of(const std::string& name, std::string& found) const;
    bool number_of(const std::string& name, double& found) const;
    bool flag_of(const std::string& name, bool& found) const;
    const std::vector<Json>& list_of(const std::string& name) const;  // empty if there is none
};

// False if the text is no such value; `found` is of no use then.
bool read_json(const std::string& text, Json& found);

}  // namespace dsfo
