// The effects of commands. Each returns why it was not carried out, or the empty text.
#pragma once

#include "commands.hpp"

namespace dsfo::effects {

// pace
std::string ask(Driver& driver, const Command& command);
std::string pause(Driver& driver, const Command& command);
std::string resume(Driver& driver, const Command& command);
std::string step(Driver& driver, const Command& command);
std::string set_automatic(Driver& driver, const Command& command);

// edges
std::string veto(Driver& driver, const Command& command);
std::string prune(Driver& driver, const Command& command);
std::string restore(Driver& driver, const Command& command);
std::string set_cost(Driver& driver, const Command& command);
std::string next_edge(Driver& driver);  // that people are asked about, else the next of the route

// people, view, trials
std::string answer(Driver& driver, const Command& command);
std::string full_map(Driver& driver, const Command& command);
std::string disturb(Driver& driver, const Command& command);
std::string inject(Driver& driver, const Command& command);

// stop, take over, and the ways back
std::string stop(Driver& driver, const Command& command);
std::string reset(Driver& driver, const Command& command);
std::string end(Driver& driver, const Command& command);
std::string take_over(Driver& driver, const Command& command);
std::string give_back(Driver& driver, const Command& command);
std::string accept(Driver& driver, const Command& command);
std::string adopt(Driver& driver, const Command& command);

}  // namespace dsfo::effects
