// What a blueprint is made of: State Branches (SBs), states, operations and flags.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dsfo {

class World;
struct Edge;

using Fact = std::pair<int, int>;  // the number of an SB, and a digit counted from 0
using Configuration = std::vector<int>;  // the active state of every SB, by number

// What a function of an operation says at each tick. `running`: call me again at the next tick, whose
// number since the operation began it gets; the first is 0.
enum class Outcome { running, returned, failed, raised };

using Function = Outcome (*)(World&, const Edge&, long tick);
using Reader = std::optional<std::string> (*)(const World&, Fact);

// Who is asked for something, and how. Times are seconds.
struct Asked {
    std::string question;
    std::vector<std::string> roles;
    std::optional<double> within;
    std::string escalates_to;
};

// A fact as the dispatcher believes it: one digit of the states of an SB.
struct Flag {
    std::string name;
    std::vector<std::string> values;
    std::string sub;  // the SB that expands it, empty if a sensor reads it
    std::string on = "1";
    std::string off = "0";
    std::vector<std::string> failure;
    bool critical = false;
    Reader read = nullptr;
    bool told_by_people = false;
    std::optional<double> max_age;
    std::vector<std::pair<std::string, std::string>> meanings;  // of its values
    std::string unit;
    Asked asked;
};

// A state: the values of its facts, and the target of each operation that is permitted.
struct State {
    std::string name;
    std::vector<std::string> facts;
    std::vector<std::pair<std::string, int>> operations;  // name, number of the target
    std::string fails;  // why it is a failure state, empty if it is none
};

// What an operation runs, and the terms on which it may. Times are seconds.
struct Operation {
    Function run = nullptr;
    std::string function;
    std::string title;
    double cost = 1.0;
    std::string risk;
    std::string actor;  // human, shared, or empty for its function
    std::vector<std::string> confirm;
    double timeout = 20.0;
    std::string stop = "hold";
    bool resumes = true;
    bool load = false;
    std::vector<int> touches;
    std::vector<std::pair<std::string, std::string>> requires_facts;
    Asked asked;
    std::string arguments;  // what a bindings file passes to its function, as a JSON object
};

// A State Branch: one finite state machine of the blueprint.
struct Branch {
    std::string name;
    int initial = 0;
    int activating = 0;
    std::vector<Flag> flags;
    std::vector<State> states;
    std::map<std::string, Operation> operations;  // by name, and by State/Operation

    const std::string& value(int state, int digit) const;
    bool is_on(int state, int digit) const;
    std::string fact_name(int digit) const;
    int number_of(const std::string& state) const;  // -1 if there is none
    const Operation& operation(int state, const std::string& name) const;
};

// Facts that must never hold together.
struct Hazard {
    std::string name;
    std::vector<std::pair<Fact, std::string>> facts;
};

struct Blueprint {
    std::vector<Branch> branches;
    std::vector<Hazard> hazards;
    std::vector<std::pair<std::string, std::string>> left_out;
    std::vector<std::pair<std::string, std::string>> levels;  // who acts, senses and supervises
    std::string findings;  // what inspection found
    std::string behaviour;
    std::string closure;
    std::string file;  // SHA-256 of its file
    std::string record;  // SHA-256 of the inspection record, empty without one
    std::string identity;  // the part of a log's header that is always the same, as JSON members

    int number_of(const std::string& branch) const;  // -1 if there is none
    const Flag& flag(Fact fact) const;
    std::vector<Fact> sensed() const;  // every fact that no sub-SB expands
    bool meets(const Hazard& hazard, const Configuration& configuration) const;
    std::string fact_text(Fact fact) const;
};

std::string escape(const std::string& name);
std::string address(const std::vector<std::string>& names);
std::vector<std::string> parts(const std::string& text);
std::optional<std::pair<std::string, int>> split_fact(const std::string& text);  // SB and digit
std::string joined(const std::vector<std::string>& texts, const std::string& between);

enum class Kind { pure, rise, fall, mixed };

struct Requirement {
    std::string key;
    Fact fact;
    std::string value;
    bool known = false;
};

// One permitted step: an operation from one state of an SB to another.
struct Edge {
    int branch = 0;
    int source = 0;
    int target = 0;
    std::string name;
    std::string address;
    const Operation* terms = nullptr;
    Kind kind = Kind::pure;
    std::vector<int> falls;
    std::vector<int> rises;
    int crossing = 0;  // 1 if it enters ACTIVATING of a sub-SB, -1 if it leaves it
    bool load = false;
    bool acts = true;  // its own function runs
    double cost = 1.0;  // its own part of the cost of a route
    double price = 1.0;  // what was declared for it
    std::vector<Requirement> needs;
    std::string fails;  // the failure that it leads into
};

// An answer: an edge cannot be carried out from here, for these reasons.
struct Unavailable {
    std::vector<std::string> reasons;
    std::string hazard;
};

}  // namespace dsfo
