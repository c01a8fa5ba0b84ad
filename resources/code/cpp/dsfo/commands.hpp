// The commands to a run: what each does, and the run states that refuse it.
//
// A command waits for the next tick. There one event answers it, and its effects follow.
#pragma once

#include "driver.hpp"

namespace dsfo {

// A command that somebody gave, with its arguments by name.
struct Command {
    std::string word;
    std::string by = "a person";
    std::map<std::string, Json> said;

    std::string text(const std::string& name) const;  // empty if it is not said
    double number(const std::string& name) const;
    bool flag(const std::string& name) const;
};

// One command of the table. `refused` has the run states that refuse it. One that `sets_going` is
// refused if one that `holds_back` came before it in the same tick; `stands` says that it holds back
// even if it was refused. `needs` and `may` are its arguments, `free` allows any others. Of the
// commands of one tick those with a smaller rank come first.
struct Row {
    std::string (*effect)(Driver& driver, const Command& command) = nullptr;
    std::map<std::string, std::string> refused;
    std::vector<std::string> needs;
    std::vector<std::string> may;
    std::vector<std::string> value;  // the arguments that the event tells as the value
    int rank = 6;
    bool sets_going = false;
    bool holds_back = false;
    bool stands = false;
    bool free = false;
};

const std::map<std::string, Row>& command_table();

// Carries out the commands of one tick, in order of rank, and answers each.
void obey(Driver& driver, std::vector<Command> commands);

// Commands that cannot be carried out any more.
void refuse(Driver& driver, const std::vector<Command>& commands, const std::string& reason);

// Nobody attends the run any more. If it waits for somebody, it ends.
void leave(Driver& driver);

Json json_of_text(const std::string& text);
Json json_of_flag(bool flag);

}  // namespace dsfo
