#include "script.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "addresses.hpp"
#include "faults.hpp"
#include "names.hpp"

namespace dsfo {

namespace {

constexpr std::size_t largest = std::size_t{1} << 24;  // bytes
constexpr std::size_t longest = std::size_t{1} << 16;  // bytes of one line
constexpr long most = 10000;  // lines

using Sort = Json::Kind;

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<std::string> moments{"at", "when", "during", "after", "times", "turn", "do", "by"};

bool is_name(const std::string& text) {
    const auto letter = [](char sign) {
        return (sign >= 'a' && sign <= 'z') || (sign >= 'A' && sign <= 'Z') || sign == '_';
    };
    return !text.empty() && letter(text[0]) && text != "self" &&
           std::all_of(text.begin(), text.end(), [&letter](char sign) {
               return letter(sign) || (sign >= '0' && sign <= '9');
           });
}

std::string shown(const Json& value) {
    const std::string whole = value.kind == Sort::text     ? value.text
                              : value.kind == Sort::number ? plain_number(value.number)
                              : value.kind == Sort::flag   ? (value.flag ? "true" : "false")
                              : value.kind == Sort::null   ? "null"
                                                           : "a list or an object";
    return json_text(whole.substr(0, 60));
}

// Reads one line. The first thing that is wrong stays.
class Line {
public:
    Line(const Hierarchy& hierarchy, const Json& values) : hierarchy_(hierarchy) {
        for (std::size_t at = 0; at < values.names.size(); ++at) {
            if (values.names[at].rfind('_', 0) != 0) {
                values_[values.names[at]] = values.items[at];
            }
        }
    }

    std::string wrong;

    bool empty() const { return values_.empty(); }

    void take(long number, Script& script) {
        const auto said = values_.find("do");
        const std::string word = said == values_.end() ? "" : said->second.text;
        const bool level = word == "level";
        const bool pace = word == "by_hand" || word == "automatic";
        const auto& table = command_table();
        const auto row = table.find(pace ? "set_automatic" : word);
        if (!level && (row == table.end() || word == "set_automatic")) {
            fail((said == values_.end() ? "''" : shown(said->second)) + " is no command");
            return;
        }
        Row own;
        if (level) {
            own.needs = {"of", "level"};
        } else {
            own = row->second;
        }
        if (pace) {
            own.needs.clear();
        }
        Act act;
        act.line = number;
        act.command.word = word;
        given(own, act.command);
        if (!wrong.empty()) {
            return;
        }
        if (level) {
            take_level(act.command, script);
            return;
        }
        act.command.by = values_.count("by") ? text(values_.at("by")) : "script";
        take_moment(act);
        if (wrong.empty()) {
            script.acts.push_back(act);
        }
    }

private:
    const Hierarchy& hierarchy_;
    std::map<std::string, Json> values_;

    void fail(const std::string& sentence) {
        if (wrong.empty()) {
            wrong = sentence;
        }
    }

    void given(const Row& row, Command& command) {
        for (const auto& [name, value] : values_) {
            if (has(moments, name)) {
                continue;
            }
            const bool known = has(row.needs, name) || has(row.may, name);
            if (!known && (!row.free || !is_name(name))) {
                fail(command.word + " takes no " + json_text(name.substr(0, 60)));
                return;
            }
            command.said[name] = known ? checked(command.word, name, value) : scalar(value);
        }
        for (const std::string& name : row.needs) {
            if (!command.said.count(name)) {
                fail(command.word + " needs '" + name + "'");
            }
        }
        if (wrong.empty() && command.word == "disturb") {
            std::map<std::string, Json> more = command.said;
            more.erase("target");
            more.erase("kind");
            disturbance_of(command.text("kind"), more, wrong);
        }
        if (wrong.empty() && command.word == "inject") {
            fail(fault_refused(command.said));
        }
    }

    Json checked(const std::string& word, const std::string& name, const Json& value) {
        if (name == "cost") {
            seconds(value);
            return value;
        }
        if (name == "on") {
            if (value.kind != Sort::flag) {
                fail(shown(value) + " is neither true nor false");
            }
            return value;
        }
        const std::string own = text(value);
        if (name == "address" && word != "answer" && wrong.empty()) {
            return json_of_text(operation(own));
        }
        if (name == "kind" && word == "answer" &&
            !has({"operation", "confirm", "fact", "supervise", "start"}, own)) {
            fail(shown(value) + " is none of operation, confirm, fact, supervise, start");
        }
        const auto fact = name == "target" ? split_fact(own) : std::nullopt;
        if (fact) {
            const int branch = hierarchy_.blueprint.number_of(fact->first);
            if (branch < 0 ||
                fact->second >= static_cast<int>(hierarchy_.of(branch).flags.size())) {
                fail("there is no fact " + shown(value) + ". Write SB/digit.");
            }
        }
        return value;
    }

    void take_level(const Command& command, Script& script) {
        for (const char* const name : {"at", "when", "during", "after", "times", "turn"}) {
            if (values_.count(name)) {
                fail("a level is set before the start, at no other moment");
            }
        }
        fail(no_level(hierarchy_, command.text("of"), command.text("level")));
        script.levels[command.text("of")] = command.text("level");
    }

    void take_moment(Act& act) {
        std::vector<std::string> said;
        for (const char* const name : {"at", "when", "during"}) {
            if (values_.count(name)) {
                said.emplace_back(name);
            }
        }
        if (said.size() > 1) {
            fail("'" + said[0] + "' and '" + said[1] + "' exclude each other");
            return;
        }
        const bool answers = said.empty() && act.command.word == "answer";
        act.turn = values_.count("turn") ? count(values_.at("turn")) : 1;
        if (!answers && (said.empty() || said[0] == "at")) {
            if (values_.count("after") || values_.count("times")) {
                fail("'after' and 'times' need a state or an operation");
            }
            act.seconds = said.empty() ? 0.0 : seconds(values_.at("at"));
            return;
        }
        act.moment = answers             ? Moment::asked
                     : said[0] == "when" ? Moment::when
                                         : Moment::during;
        if (!answers) {
            const std::string named = text(values_.at(said[0]));
            act.address = !wrong.empty()                 ? ""
                          : act.moment == Moment::when ? state(named)
                                                       : operation(named);
        }
        const auto times = values_.find("times");
        const bool every = times != values_.end() && times->second.text == "every";
        act.times = every ? 0 : times == values_.end() ? 1 : count(times->second);
        act.seconds = values_.count("after") ? seconds(values_.at("after")) : 0.0;
    }

    long count(const Json& value) {
        const bool good = value.kind == Sort::number && value.number >= 1.0 &&
                          value.number <= 1e6 && std::floor(value.number) >= value.number;
        if (!good) {
            fail(shown(value) + " is no count. Write a number from 1 on.");
        }
        return good ? static_cast<long>(value.number) : 1;
    }

    double seconds(const Json& value) {
        if (value.kind != Sort::number || value.number < 0.0 || value.number >= 1e9) {
            fail(shown(value) + " is no number from 0 to 1e+09. Write it like 2.5.");
        }
        return value.number;
    }

    std::string text(const Json& value) {
        if (value.kind != Sort::text || !is_printable(value.text)) {
            fail(shown(value) + " is no text. Write it in quotes: \"...\".");
        }
        return value.text;
    }

    Json scalar(const Json& value) {
        if (value.kind != Sort::text && value.kind != Sort::number) {
            fail(shown(value) + " is neither a text nor a number");
        }
        return value;
    }

    std::string state(const std::string& written) {
        std::string no;
        const std::map<int, int> found = states_at(hierarchy_, {written}, "moment", no);
        if (!no.empty()) {
            fail(no);
            return "";
        }
        const Branch& branch = hierarchy_.of(found.begin()->first);
        const auto at = static_cast<std::size_t>(found.begin()->second);
        return address({branch.name, branch.states[at].name});
    }

    std::string operation(const std::string& written) {
        std::string no;
        const std::vector<std::string> found = operations_at(hierarchy_, {written}, no);
        if (!no.empty() || found.size() != 1) {
            const std::string many = std::to_string(found.size());
            fail(
                !no.empty() ? no
                            : json_text(written) + " stands for " + many +
                                  " operations. Write SB/State/Operation.");
            return "";
        }
        return found.front();
    }
};

std::string take_line(
    const std::string& raw, long number, const Hierarchy& hierarchy, Script& script) {
    if (raw.size() > longest) {
        return "the line is longer than 65,536 bytes";
    }
    if (raw.find_first_not_of(" \t\r") == std::string::npos) {
        return "";
    }
    Json values;
    if (!read_json(raw, values) || values.kind != Sort::object) {
        return "the line is no JSON object in UTF-8, each key once";
    }
    Line line(hierarchy, values);
    if (!line.empty()) {
        line.take(number, script);
    }
    return line.wrong;
}

}  // namespace

std::string Act::words() const {
    std::string found = command.word;
    std::replace(found.begin(), found.end(), '_', ' ');
    for (const auto& [name, value] : command.said) {
        (void)name;
        found += " " + (value.kind == Sort::number ? plain_number(value.number)
                        : value.kind == Sort::flag ? std::string(value.flag ? "true" : "false")
                                                   : value.text);
    }
    return found;
}

Script read_script(const std::string& path, const Hierarchy& hierarchy, std::string& wrong) {
    Script script;
    script.file = path;
    std::ifstream file(path, std::ios::binary);
    std::string raw;
    for (char sign = 0; raw.size() <= largest && file.get(sign);) {
        raw += sign;
    }
    if (!file.is_open() || file.bad() || (raw.empty() && !file.eof())) {
        wrong = path + ":1:1: the script cannot be read";
        return script;
    }
    if (raw.size() > largest || std::count(raw.begin(), raw.end(), '\n') >= most) {
        wrong = path + ":1:1: the script has more than 16 MB or 10,000 lines";
        return script;
    }
    long number = 0;
    for (std::size_t from = 0; from <= raw.size() && wrong.empty();) {
        const std::size_t end = std::min(raw.find('\n', from), raw.size());
        std::string line = raw.substr(from, end - from);
        if (line.rfind("\xef\xbb\xbf", 0) == 0) {
            line.erase(0, 3);
        }
        const std::string no = take_line(line, ++number, hierarchy, script);
        if (!no.empty()) {
            wrong = path + ":" + std::to_string(number) + ":1: " + no;
        }
        from = end + 1;
    }
    Sha256 hash;
    hash.add(raw);
    script.digest = hash.hex();
    return script;
}

}  // namespace dsfo
