// From an edge to its joint step, or to the reasons why there is none (clauses 2, 5, 6 and 10).
#pragma once

#include <memory>
#include <set>
#include <variant>

#include "hierarchy.hpp"

namespace dsfo {

// SBs with the states in which they are, in the order in which they were put.
class Places {
public:
    void put(int branch, int state);
    void put_all(const Places& other);
    void apply(Configuration& configuration) const;
    std::optional<int> at(int branch) const;

    std::vector<std::pair<int, int>> all;
};

// One function of a joint step and its effects.
struct Action {
    const Edge* edge = nullptr;
    std::vector<const Edge*> begins;  // the edges that start with it, bases first
    Places moved;  // the SBs that have moved when it is done
    std::vector<const Edge*> commits;
    Places committed;
    std::set<Fact> transit;  // the base digits in transit while it runs
    std::set<Fact> after;  // those that still are afterwards

    Places targets() const;
};

// What carrying out `asked` does. `edges` are in the order in which they start.
struct JointStep {
    const Edge* asked = nullptr;
    std::vector<const Edge*> edges;
    std::vector<Action> actions;
    double cost = 0.0;
    Places after;

    std::vector<std::string> names(int branch) const;
};

using StepPointer = std::shared_ptr<const JointStep>;
using StepAnswer = std::variant<StepPointer, Unavailable>;

// The edges of one blueprint.
class Edges {
public:
    explicit Edges(const Hierarchy& hierarchy);

    const std::vector<Edge>& out(int branch, int state) const;
    const Edge* find(const std::string& address) const;
    std::vector<std::string> missing(const Edge& edge, const Configuration& here) const;
    std::set<int> requiring(int branch) const;
    double price(const std::string& address) const;
    void set_price(const std::string& address, double price);  // plans made before are void

private:
    Edge made(int branch, int source, const std::string& name, int target) const;
    std::vector<Requirement> required(const Operation& terms) const;

    const Hierarchy& hierarchy_;
    std::vector<std::vector<std::vector<Edge>>> out_;
};

using Shut = std::map<std::string, std::string>;  // addresses of edges, with reasons
class Draft;
struct Carried;

class Stepper {
public:
    // `failing` are the edges that may lead into a failure state.
    Stepper(
        const Hierarchy& hierarchy, const Edges& edges, Shut shut,
        std::set<std::string> failing = {});
    ~Stepper();

    StepAnswer step(const Configuration& configuration, const Edge& edge);
    std::vector<std::string> closures(const Edge& edge) const;
    bool allows(const Configuration& configuration, const Edge& edge) const;
    void renew() { work_ = 0; }
    bool spend(std::size_t edges);  // false if that is more than one plan may take

    const Hierarchy& hierarchy;
    const Edges& edges;

private:
    using Held = std::map<int, Carried*>;
    using Refusal = std::optional<Unavailable>;
    using Route = std::variant<std::vector<const Edge*>, Unavailable>;

    Refusal allow(const Configuration& configuration, const Edge& edge) const;
    Refusal carry(Draft& draft, const Edge& edge, const Held& held);
    Refusal along(
        const Configuration& here, const Edge& edge, const Places& places, const Held& held,
        std::vector<const Edge*>& found) const;
    Refusal take(
        const Configuration& here, int sub, int crossing,
        std::vector<std::pair<int, const Edge*>>& taken, const std::set<int>& loaded) const;
    Refusal loaded(const Configuration& here, const Edge& edge, Places& places) const;
    Refusal drive(Draft& draft, const Edge& edge, const Held& held);
    Route sub_route(const Configuration& here, int sub, int goal, const Held& held);
    Route search(const Configuration& here, int sub, int goal, const Held& held);
    std::vector<int> region(int sub, const Held& held, std::vector<int>& border) const;
    int crossing(const Configuration& here, int sub, int state) const;
    Refusal hazards_of(const Configuration& before, const JointStep& step) const;

    Shut shut_;
    std::set<std::string> failing_;
    std::map<std::pair<Configuration, const Edge*>, StepAnswer> steps_;
    std::map<std::vector<int>, Route> routes_;
    std::size_t work_ = 0;
};

double rounded(double cost);  // to nine decimals, as all costs are compared

}  // namespace dsfo
