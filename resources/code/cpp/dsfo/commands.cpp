#include "commands.hpp"

#include <algorithm>

#include "effects.hpp"

namespace dsfo {

namespace {

const std::vector<std::string> phases{
    "ready",      "running",    "paused", "waiting", "no_route",
    "taken_over", "fault_hold", "stopped"};

const char* const is_stopped = "the run is stopped, reset it first";
const char* const is_taken =
    "{by} has taken over, automation is locked out until it is given back";
const char* const are_asked = "people are being asked, it goes on when they have answered";
const char* const holds_already = "the run holds already";

using Refused = std::map<std::string, std::string>;

Refused only(const std::string& words, const std::vector<std::string>& allowed) {
    Refused found;
    for (const std::string& phase : phases) {
        if (std::find(allowed.begin(), allowed.end(), phase) == allowed.end()) {
            found[phase] = words;
        }
    }
    return found;
}

Refused locked(const Refused& more) {
    Refused found{{"taken_over", is_taken}, {"stopped", is_stopped}};
    found.insert(more.begin(), more.end());
    return found;
}

enum Rank { first = 0, second, fault, terms, pausing, stepping, running };

Row row(std::string (*effect)(Driver&, const Command&), Refused refused, Rank rank = running) {
    Row found;
    found.effect = effect;
    found.refused = std::move(refused);
    found.rank = rank;
    return found;
}

Row going(Row row) {
    row.sets_going = true;
    return row;
}

Row holding(Row row, bool stands) {
    row.holds_back = true;
    row.stands = stands;
    return row;
}

Row with(
    Row row, std::vector<std::string> needs, std::vector<std::string> may = {},
    std::vector<std::string> value = {}, bool free = false) {
    row.needs = std::move(needs);
    row.may = std::move(may);
    row.value = std::move(value);
    row.free = free;
    return row;
}

std::map<std::string, Row> made_table() {
    const Refused waits{{"waiting", are_asked}};
    const Refused nobody = only("nobody has taken over", {"taken_over"});
    return {
        {"ask", going(with(row(effects::ask, locked(waits)), {"address"}))},
        {"pause", holding(
                      row(effects::pause,
                          locked({{"paused", "it is paused already"},
                                  {"no_route", holds_already},
                                  {"fault_hold", holds_already}}),
                          pausing),
                      true)},
        {"resume", going(row(
                       effects::resume,
                       locked({{"running", "it runs already"}, {"waiting", are_asked}})))},
        {"step", going(holding(row(effects::step, locked(waits), stepping), false))},
        {"set_automatic",
         going(with(
             row(effects::set_automatic, locked({})), {"automatic"}, {}, {"automatic"}))},
        {"veto", with(row(effects::veto, locked({}), terms), {}, {"address"})},
        {"prune", with(row(effects::prune, {}, terms), {"address", "reason"})},
        {"restore", with(row(effects::restore, {}, terms), {"address"})},
        {"set_cost",
         with(row(effects::set_cost, {}, terms), {"address", "cost"}, {}, {"cost"})},
        {"take_over", holding(
                          row(effects::take_over,
                              {{"taken_over", "{by} has taken over already"},
                               {"stopped", is_stopped}},
                              second),
                          true)},
        {"give_back", going(row(effects::give_back, nobody))},
        {"accept", going(row(effects::accept, nobody))},
        {"adopt",
         going(row(effects::adopt, only("the run does not hold on a mismatch", {"fault_hold"})))},
        {"stop", holding(row(effects::stop, {{"stopped", "it is stopped already"}}, first), true)},
        {"reset", going(row(effects::reset, only("the run is not stopped", {"stopped"})))},
        {"end",
         row(effects::end,
             only(
                 "only a run that is stopped or holds can be ended, stop it first",
                 {"stopped", "no_route", "fault_hold"}))},
        {"answer",
         with(row(effects::answer, {}), {"option"}, {"kind", "address", "role"}, {"task"})},
        {"full_map", with(row(effects::full_map, {}), {"on"}, {}, {"on"})},
        {"disturb", with(
                        row(effects::disturb, {}, fault), {"target", "kind"}, {},
                        {"target", "kind"}, true)},
        {"inject", with(row(effects::inject, {}, fault), {"fault"}, {}, {"fault"}, true)}};
}

std::string written(const Command& command, const std::string& name) {
    const auto found = command.said.find(name);
    if (found == command.said.end()) {
        return "";
    }
    const Json& value = found->second;
    return value.kind == Json::Kind::flag     ? (value.flag ? "on" : "off")
           : value.kind == Json::Kind::number ? json_number(value.number)
                                              : value.text;
}

// The event that answers a command.
std::string told(const LiveRun& run, const Command& command, const std::string& refused) {
    const Row& own = command_table().at(command.word);
    const auto takes = [&own](const std::string& name) {
        return std::count(own.needs.begin(), own.needs.end(), name) +
                   std::count(own.may.begin(), own.may.end(), name) >
               0;
    };
    const bool names_edge = takes("address") && command.word != "answer";
    const bool reasoned = command.word == "prune" || command.word == "veto";
    std::vector<std::string> value;
    for (const std::string& name : own.value) {
        value.push_back(written(command, name));
    }
    Object said = run.event("commanded");
    said.text("command", command.word).text("by", command.by);
    said.text("address", names_edge ? command.text("address") : "");
    said.text("value", joined(value, " "));
    said.text("reason", reasoned ? command.text("reason") : "");
    return said.text("refused", refused).str();
}

std::string why_not(
    const Driver& driver, const Command& command, const std::vector<Command>& done) {
    if (driver.ended()) {
        return "the run is over";
    }
    const Row& own = command_table().at(command.word);
    const auto refused = own.refused.find(driver.phase());
    if (refused != own.refused.end()) {
        std::string words = refused->second;
        const std::size_t at = words.find("{by}");
        if (at != std::string::npos) {
            std::string by = driver.state.taken_over;
            if (!by.empty() && by[0] >= 'a' && by[0] <= 'z') {
                by[0] = static_cast<char>(by[0] - 32);
            }
            words.replace(at, 4, by);
        }
        return words;
    }
    for (const Command& one : done) {
        const Row& other = command_table().at(one.word);
        if (own.sets_going && other.holds_back && other.rank < own.rank) {
            std::string word = one.word;
            std::replace(word.begin(), word.end(), '_', ' ');
            return word + " came at the same tick and counts more";
        }
    }
    return "";
}

}  // namespace

std::string Command::text(const std::string& name) const {
    const auto found = said.find(name);
    return found == said.end() ? "" : found->second.text;
}

double Command::number(const std::string& name) const {
    const auto found = said.find(name);
    return found == said.end() ? 0.0 : found->second.number;
}

bool Command::flag(const std::string& name) const {
    const auto found = said.find(name);
    return found != said.end() && found->second.flag;
}

const std::map<std::string, Row>& command_table() {
    static const std::map<std::string, Row> table = made_table();
    return table;
}

void obey(Driver& driver, std::vector<Command> commands) {
    const auto& table = command_table();
    std::stable_sort(
        commands.begin(), commands.end(), [&table](const Command& one, const Command& other) {
            return table.at(one.word).rank < table.at(other.word).rank;
        });
    std::vector<Command> done;
    for (Command& command : commands) {
        const auto at = static_cast<std::ptrdiff_t>(driver.run.events.size());
        const Row& own = table.at(command.word);
        std::string refused = driver.run.gone() ? driver.run.world.lost()
                                                : why_not(driver, command, done);
        if (refused.empty()) {
            if (command.word == "veto" && command.text("address").empty()) {
                command.said["address"] = json_of_text(effects::next_edge(driver));
            }
            refused = own.effect(driver, command);
        }
        if (refused.empty() || own.stands) {
            done.push_back(command);
        }
        std::vector<std::string>& events = driver.run.events;
        events.insert(events.begin() + at, told(driver.run, command, refused));
    }
}

void refuse(Driver& driver, const std::vector<Command>& commands, const std::string& reason) {
    for (const Command& command : commands) {
        driver.run.events.push_back(told(driver.run, command, reason));
    }
}

Json json_of_text(const std::string& text) {
    Json found;
    found.kind = Json::Kind::text;
    found.text = text;
    return found;
}

Json json_of_flag(bool flag) {
    Json found;
    found.kind = Json::Kind::flag;
    found.flag = flag;
    return found;
}

}  // namespace dsfo
