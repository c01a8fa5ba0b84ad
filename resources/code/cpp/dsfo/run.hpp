// The data of one run: where it stands, what it senses, state checks, guards and hazards (clauses 4,
// 9 and 13).
#pragma once

#include "log.hpp"
#include "senses.hpp"
#include "steps.hpp"

namespace dsfo {

inline const char* const in_transit = "in transit";  // the reason of a term that is left out

// One fact of a state check. `truth` is empty if it is unknown.
struct Term {
    Fact fact;
    std::string wanted;
    std::optional<std::string> reading;
    std::optional<bool> truth;
    std::string reason;
};

struct Check {
    int branch = 0;
    int state = 0;
    std::vector<Term> terms;

    std::optional<bool> truth() const;  // false if a term is false, else empty if one is unknown
    bool is_true() const { return truth().value_or(false); }
    std::vector<Term> misses() const;
    std::vector<Term> unknown() const;
};

struct Objection {
    std::string hazard;
    std::string sentence;
};

class LiveRun {
public:
    LiveRun(
        const Hierarchy& hierarchy, World& world, const Levels& levels, Configuration start,
        long seed);

    const Hierarchy& hierarchy;
    const Blueprint& blueprint;
    World& world;
    const Levels& levels;
    Senses senses;
    Configuration configuration;  // committed
    Places pending;  // what has moved and is not committed
    std::set<Fact> transit;  // base digits in transit
    Places moving;  // where a running function leads
    long operations = 0;  // committed edges
    long ticks = 0;
    std::set<std::string> told_hazards;
    std::vector<std::string> events;  // of this tick, as JSON

    double time() const { return static_cast<double>(ticks) * world.tick(); }
    Configuration believed() const;
    Object event(const std::string& word) const;
    void tell(const Object& event) { events.push_back(event.str()); }
    std::string address_of(int branch, int state) const;
    std::string json_of(const Configuration& states) const;
    std::string json_of(const Places& places) const;

    void look();  // read every sensor now
    bool gone() const { return !world.lost().empty(); }
    void pass_tick();  // let the world go on for one tick, and look
    void doubt(const std::set<Fact>& facts, const std::string& reason);
    void forget(const std::set<Fact>& facts);  // what people have said about them
    void take_answer(Fact fact, const std::string& value, const std::string& who);

    Check check(int branch, int state, const std::set<Fact>& left_out = {}) const;
    std::vector<Check> checks(const Configuration& all) const;
    bool stands(const Configuration& all) const;
    std::vector<Term> broken() const;
    std::vector<int> fitting(int branch, const Configuration& all) const;
    void tell_check(const Check& check);
    std::string words(const Term& term, const std::string& what = "") const;
    std::vector<std::string> words(const std::vector<Term>& terms) const;
    std::string why_not(const Check& check) const;
    std::vector<std::string> odd_words(const std::vector<Check>& checks) const;

    void commit(const Action& action);
    void drop_pending();

    std::vector<std::string> refusals(const JointStep& step) const;
    std::vector<Term> needs(const Edge& edge) const;  // what it requires, as it is sensed
    std::vector<Term> lost_terms(const std::set<Fact>& changing = {}) const;
    std::vector<std::string> lost_critical(const std::set<Fact>& changing = {}) const;
    std::vector<std::string> unmet(const Edge& edge, const std::set<Fact>& changing) const;
    std::vector<Hazard> met();
    void tell_hazards(const std::vector<Hazard>& hazards);
    std::vector<std::string> met_words(const std::vector<Hazard>& hazards) const;
    std::optional<Objection> objection(
        const std::string& asked, const std::vector<Action>& actions) const;
    // The unknown facts because of which a hazard would refuse a step.
    std::vector<Fact> doubtful(const std::vector<Action>& actions) const;

    std::set<Fact> differing(int branch, int source, int target) const;
    std::set<Fact> changed_by(const Action& action) const;
    std::set<Fact> touched(
        const std::vector<Action>& begun, const std::set<std::string>& still_open) const;
    std::set<int> moved_by(const Edge& edge) const;

private:
    std::vector<Term> terms(
        int branch, int state, const Configuration& all, const std::set<Fact>& left_out) const;
    Term sub_term(
        Fact fact, const std::string& wanted, const Configuration& all,
        const std::set<Fact>& left_out) const;
    std::optional<std::string> seen(
        Fact fact, const std::set<Fact>& left_out,
        const std::map<Fact, std::string>& declared) const;
    std::optional<bool> truth(
        const std::vector<std::pair<Fact, std::string>>& facts, const std::set<Fact>& left_out,
        const std::map<Fact, std::string>& declared) const;
    void take_changes();
    using Declared = std::map<Fact, std::string>;
    using Moments = std::vector<std::pair<std::set<Fact>, Declared>>;  // what is in transit, and said
    Moments moments(const std::vector<Action>& actions, std::set<Fact>& changed) const;
    std::vector<Fact> unknown_of(
        const Hazard& hazard, const Moments& moments, const std::set<Fact>& changed) const;
    std::string hazard_facts(const Hazard& hazard) const;

    std::map<Fact, std::optional<std::string>> told_;
};

}  // namespace dsfo
