// Base SBs and sub-SBs, the configurations in which they agree, and goals (clauses 1, 3 and 11).
//
// The rule under all others: a digit that a sub-SB expands is on exactly while the sub-SB is in its
// ACTIVATING state.
#pragma once

#include "elements.hpp"

namespace dsfo {

using Goal = std::pair<int, int>;  // an SB and the state in which it shall be

class Hierarchy {
public:
    explicit Hierarchy(const Blueprint& blueprint);

    const Blueprint& blueprint;
    std::vector<std::vector<std::pair<int, int>>> subs;  // by SB: digit, sub-SB
    std::vector<std::vector<Fact>> bases;  // by SB: base, digit
    std::vector<int> order;  // every SB after its bases, else in the order of the file
    std::vector<int> place;  // by SB: where it stands in the order
    std::vector<int> roots;

    std::vector<int> tree(int branch) const;  // it and everything below it, bases first
    std::vector<int> roots_of(int branch) const;
    bool is_active(int sub, int state) const;
    int rest(int sub, bool on) const;  // ACTIVATING if its digit is on, else INITIAL
    int sub_at(int branch, int digit) const;
    const Branch& of(int branch) const;
    std::vector<Fact> disagreements(const Configuration& configuration) const;

    // An SB in a state, and everything below it as at a start: pairs of SB and state.
    std::map<int, int> standing(int branch, int state) const;
};

// Where every SB stands at the start. `refused` says why a run cannot start there.
Configuration start_configuration(
    const Hierarchy& hierarchy, const std::map<int, int>& given, std::string& refused);

// The goals in the order in which they are pursued. `refused` says why they contradict each other.
std::vector<Goal> goals_of(
    const Hierarchy& hierarchy, const std::map<int, int>& asked, std::string& refused);

bool holds(const Configuration& configuration, const std::vector<Goal>& goals);

}  // namespace dsfo
