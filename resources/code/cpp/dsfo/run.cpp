#include "run.hpp"

#include <algorithm>

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

}  // namespace

std::optional<bool> Check::truth() const {
    bool known = true;
    for (const Term& term : terms) {
        if (term.truth && !*term.truth) {
            return false;
        }
        known = known && term.truth.has_value();
    }
    return known ? std::optional<bool>(true) : std::nullopt;
}

std::vector<Term> Check::misses() const {
    std::vector<Term> found;
    std::copy_if(terms.begin(), terms.end(), std::back_inserter(found), [](const Term& term) {
        return term.truth && !*term.truth;
    });
    return found;
}

std::vector<Term> Check::unknown() const {
    std::vector<Term> found;
    std::copy_if(terms.begin(), terms.end(), std::back_inserter(found), [](const Term& term) {
        return !term.truth;
    });
    return found;
}

LiveRun::LiveRun(
    const Hierarchy& known, World& its_world, const Levels& its_levels, Configuration start,
    long seed)
    : hierarchy(known),
      blueprint(known.blueprint),
      world(its_world),
      levels(its_levels),
      senses(known, its_world, its_levels, seed),
      configuration(std::move(start)) {}

Configuration LiveRun::believed() const {
    Configuration found = configuration;
    pending.apply(found);
    return found;
}

Object LiveRun::event(const std::string& word) const {
    Object found;
    found.text("event", word).number("t", time());
    return found;
}

std::string LiveRun::address_of(int branch, int state) const {
    const Branch& own = hierarchy.of(branch);
    return address({own.name, own.states[index(state)].name});
}

std::string LiveRun::json_of(const Configuration& states) const {
    std::vector<std::pair<std::string, std::string>> found;
    for (const int one : hierarchy.order) {
        const Branch& own = hierarchy.of(one);
        found.emplace_back(own.name, own.states[index(states[index(one)])].name);
    }
    return json_map(found);
}

std::string LiveRun::json_of(const Places& places) const {
    std::vector<std::pair<std::string, std::string>> found;
    for (const auto& [branch, state] : places.all) {
        const Branch& own = hierarchy.of(branch);
        found.emplace_back(own.name, own.states[index(state)].name);
    }
    return json_map(found);
}

// senses --------------------------------------------------------------------------------------------

void LiveRun::look() {
    senses.look(time());
    take_changes();
}

void LiveRun::pass_tick() {
    world.step();
    ++ticks;
    look();
}

void LiveRun::doubt(const std::set<Fact>& facts, const std::string& reason) {
    senses.doubt(facts, reason, time());
    take_changes();
}

void LiveRun::forget(const std::set<Fact>& facts) {
    if (senses.forget(facts, time())) {
        take_changes();
    }
}

void LiveRun::take_answer(Fact fact, const std::string& value, const std::string& who) {
    senses.answer(fact, value, who, time());
    take_changes();
}

void LiveRun::take_changes() {
    for (const auto& [fact, reading] : senses.scene) {
        const auto known = told_.find(fact);
        if (known == told_.end() || known->second != reading.value) {
            told_[fact] = reading.value;
            Object said = event("fact_changed");
            said.text("branch", hierarchy.of(fact.first).name).count("digit", fact.second);
            said.raw("value", reading.value ? json_text(*reading.value) : "null");
            tell(said.text("reason", reading.value ? "" : reading.reason));
        }
    }
}

// state checks --------------------------------------------------------------------------------------

std::vector<Term> LiveRun::terms(
    int branch, int state, const Configuration& all, const std::set<Fact>& left_out) const {
    std::vector<Term> found;
    const Branch& own = hierarchy.of(branch);
    for (int digit = 0; digit < static_cast<int>(own.flags.size()); ++digit) {
        const Fact fact{branch, digit};
        const std::string& wanted = own.value(state, digit);
        if (left_out.count(fact)) {
            found.push_back(Term{fact, wanted, std::nullopt, std::nullopt, in_transit});
            continue;
        }
        if (!own.flags[index(digit)].sub.empty()) {
            found.push_back(sub_term(fact, wanted, all, left_out));
            continue;
        }
        const auto reading = senses.scene.find(fact);
        if (reading == senses.scene.end()) {
            const std::string& value = own.value(all[index(branch)], digit);
            found.push_back(
                Term{fact, wanted, value, value == wanted, "believed, nobody senses it"});
        } else if (!reading->second.value) {
            found.push_back(
                Term{fact, wanted, std::nullopt, std::nullopt, reading->second.reason});
        } else {
            const std::string& value = *reading->second.value;
            found.push_back(Term{fact, wanted, value, value == wanted, ""});
        }
    }
    return found;
}

Term LiveRun::sub_term(
    Fact fact, const std::string& wanted, const Configuration& all,
    const std::set<Fact>& left_out) const {
    const Flag& flag = blueprint.flag(fact);
    const int sub = hierarchy.sub_at(fact.first, fact.second);
    const Check inner{
        sub, hierarchy.of(sub).activating,
        terms(sub, hierarchy.of(sub).activating, all, left_out)};
    const std::optional<bool> there = inner.truth();
    if (!there) {
        std::vector<std::string> names;
        for (const Term& term : inner.unknown()) {
            if (term.reason != in_transit) {
                names.push_back(
                    hierarchy.of(term.fact.first).name + "/" + std::to_string(term.fact.second));
            }
        }
        const std::string reason =
            names.empty() ? in_transit
                          : joined(names, ", ") + " in " + flag.sub + " is unknown";
        return Term{fact, wanted, std::nullopt, std::nullopt, reason};
    }
    const bool truth = *there == (wanted == flag.on);
    return Term{fact, wanted, *there ? flag.on : flag.off, truth, "the check of " + flag.sub};
}

Check LiveRun::check(int branch, int state, const std::set<Fact>& left_out) const {
    Configuration all = believed();
    all[index(branch)] = state;
    Check found{branch, state, {}};
    for (const Term& term : terms(branch, state, all, left_out)) {
        if (left_out.empty() || term.reason != in_transit) {
            found.terms.push_back(term);
        }
    }
    return found;
}

std::vector<Check> LiveRun::checks(const Configuration& all) const {
    std::vector<Check> found;
    for (const int one : hierarchy.order) {
        const int state = all[index(one)];
        found.push_back(Check{one, state, terms(one, state, all, {})});
    }
    return found;
}

bool LiveRun::stands(const Configuration& all) const {
    const std::vector<Check> every = checks(all);
    return std::all_of(
        every.begin(), every.end(), [](const Check& one) { return one.is_true(); });
}

std::vector<Term> LiveRun::broken() const {
    std::vector<Term> found;
    const Configuration all = believed();
    for (const int one : hierarchy.order) {
        const int state = all[index(one)];
        const Check own{one, state, terms(one, state, all, transit)};
        const std::vector<Term> misses = own.misses();
        found.insert(found.end(), misses.begin(), misses.end());
    }
    return found;
}

std::vector<int> LiveRun::fitting(int branch, const Configuration& all) const {
    const Branch& own = hierarchy.of(branch);
    const std::vector<Term> read = terms(branch, 0, all, {});
    std::vector<int> found;
    if (std::any_of(read.begin(), read.end(), [](const Term& term) { return !term.truth; })) {
        return found;
    }
    for (int state = 0; state < static_cast<int>(own.states.size()); ++state) {
        const bool fits = std::all_of(read.begin(), read.end(), [&](const Term& term) {
            const Flag& flag = blueprint.flag(term.fact);
            const std::string& value = own.value(state, term.fact.second);
            if (flag.sub.empty()) {
                return value == *term.reading;
            }
            return (value == flag.on) == (*term.truth == (term.wanted == flag.on));
        });
        if (fits) {
            found.push_back(state);
        }
    }
    return found;
}

void LiveRun::tell_check(const Check& check) {
    const std::optional<bool> truth = check.truth();
    Object said = event("state_checked");
    said.text("address", address_of(check.branch, check.state));
    said.text("result", !truth ? "unknown" : *truth ? "true" : "false");
    said.raw("misses", json_list(words(check.misses())));
    tell(said.raw("unknown", json_list(words(check.unknown()))));
}

std::string LiveRun::words(const Term& term, const std::string& what) const {
    const Branch& own = hierarchy.of(term.fact.first);
    const std::string subject = own.fact_name(term.fact.second) + " of " + own.name + what;
    if (!term.truth) {
        return subject + " is unknown, " + term.reason;
    }
    return subject + " reads " + term.reading.value_or("") +
           (*term.truth ? "" : ", not " + term.wanted);
}

std::vector<std::string> LiveRun::words(const std::vector<Term>& some) const {
    std::vector<std::string> found;
    for (const Term& term : some) {
        found.push_back(words(term));
    }
    return found;
}

std::string LiveRun::why_not(const Check& check) const {
    const Branch& own = hierarchy.of(check.branch);
    return own.name + "/" + own.states[index(check.state)].name + " does not check true: " +
           joined(odd_words({check}), "; ");
}

std::vector<std::string> LiveRun::odd_words(const std::vector<Check>& some) const {
    std::vector<std::string> found;
    for (const Check& check : some) {
        for (const std::vector<Term>& odd : {check.misses(), check.unknown()}) {
            const std::vector<std::string> said = words(odd);
            found.insert(found.end(), said.begin(), said.end());
        }
    }
    return found;
}

// changes -------------------------------------------------------------------------------------------

void LiveRun::commit(const Action& action) {
    action.committed.apply(configuration);
    operations += static_cast<long>(action.commits.size());
    Places left;
    for (const auto& [branch, state] : pending.all) {
        if (configuration[index(branch)] != state) {
            left.put(branch, state);
        }
    }
    pending = left;
    std::vector<std::string> edges;
    for (const Edge* edge : action.commits) {
        edges.push_back(edge->address);
    }
    Object said = event("committed");
    said.raw("operations", json_list(edges));
    tell(said.raw("configuration", json_of(action.committed)));
}

void LiveRun::drop_pending() {
    pending = {};
    transit.clear();
    moving = {};
}

// guards --------------------------------------------------------------------------------------------

std::vector<std::string> LiveRun::refusals(const JointStep& step) const {
    std::vector<std::string> found;
    const auto add = [&found](const std::string& reason) {
        if (std::find(found.begin(), found.end(), reason) == found.end()) {
            found.push_back(reason);
        }
    };
    std::set<int> left;
    for (const Edge* edge : step.edges) {
        if (left.insert(edge->branch).second &&
            edge->source == configuration[index(edge->branch)]) {
            const Check source = check(edge->branch, edge->source);
            if (!source.is_true()) {
                add(why_not(source));
            }
        }
    }
    for (const std::string& reason : lost_critical()) {
        add(reason);
    }
    std::set<int> moved;
    for (const Edge* edge : step.edges) {
        for (const Term& term : needs(*edge)) {
            const auto [branch, digit] = term.fact;
            if (!moved.count(branch) && !term.truth.value_or(false)) {
                add(edge->address + " requires " + hierarchy.of(branch).name + "/" +
                    std::to_string(digit) + " to be " + term.wanted + ": " + words(term));
            }
        }
        const std::set<int> its = moved_by(*edge);
        moved.insert(its.begin(), its.end());
    }
    return found;
}

std::vector<Term> LiveRun::needs(const Edge& edge) const {
    std::vector<Term> found;
    for (const Requirement& need : edge.needs) {
        if (need.known) {
            const auto [branch, digit] = need.fact;
            Term term = check(branch, configuration[index(branch)]).terms[index(digit)];
            term.wanted = need.value;
            term.truth = term.reading ? std::optional<bool>(*term.reading == need.value)
                                      : std::nullopt;
            found.push_back(term);
        }
    }
    return found;
}

std::vector<Term> LiveRun::lost_terms(const std::set<Fact>& changing) const {
    std::vector<Term> found;
    std::set<Fact> left_out = transit;
    left_out.insert(changing.begin(), changing.end());
    const Configuration all = believed();
    for (int branch = 0; branch < static_cast<int>(blueprint.branches.size()); ++branch) {
        const std::vector<Flag>& flags = hierarchy.of(branch).flags;
        for (int digit = 0; digit < static_cast<int>(flags.size()); ++digit) {
            if (!flags[index(digit)].critical) {
                continue;
            }
            const Term term = terms(branch, all[index(branch)], all, left_out)[index(digit)];
            if (!term.truth.value_or(false) && term.reason != in_transit) {
                found.push_back(term);
            }
        }
    }
    return found;
}

std::vector<std::string> LiveRun::lost_critical(const std::set<Fact>& changing) const {
    std::vector<std::string> found;
    for (const Term& term : lost_terms(changing)) {
        found.push_back(words(term, ", a critical fact,"));
    }
    return found;
}

std::vector<std::string> LiveRun::unmet(const Edge& edge, const std::set<Fact>& changing) const {
    std::vector<std::string> found;
    std::set<Fact> left_out = transit;
    left_out.insert(changing.begin(), changing.end());
    const Configuration all = believed();
    for (const Requirement& need : edge.needs) {
        const auto [branch, digit] = need.fact;
        if (!need.known) {
            continue;
        }
        Term term = terms(branch, all[index(branch)], all, left_out)[index(digit)];
        if (term.reading == need.value || term.reason == in_transit) {
            continue;
        }
        term.wanted = need.value;
        term.truth = term.reading ? std::optional<bool>(false) : std::nullopt;
        found.push_back(
            edge.address + " requires " + hierarchy.of(branch).name + "/" +
            std::to_string(digit) + " to be " + need.value + ": " + words(term));
    }
    return found;
}

// hazards -------------------------------------------------------------------------------------------

std::optional<std::string> LiveRun::seen(
    Fact fact, const std::set<Fact>& left_out, const std::map<Fact, std::string>& declared) const {
    const auto said = declared.find(fact);
    if (said != declared.end()) {
        return said->second;
    }
    const auto [branch, digit] = fact;
    const Branch& own = hierarchy.of(branch);
    const Flag& flag = blueprint.flag(fact);
    const std::optional<int> leads = moving.at(branch);
    if (left_out.count(fact) && leads) {
        return std::nullopt;
    }
    if (!flag.sub.empty() && left_out.count(fact) == 0) {
        const int sub = hierarchy.sub_at(branch, digit);
        const Branch& below = hierarchy.of(sub);
        std::vector<std::pair<Fact, std::string>> facts;
        for (int at = 0; at < static_cast<int>(below.flags.size()); ++at) {
            facts.emplace_back(Fact{sub, at}, below.value(below.activating, at));
        }
        const std::optional<bool> there = truth(facts, left_out, declared);
        return there ? std::optional<std::string>(*there ? flag.on : flag.off) : std::nullopt;
    }
    const auto reading = senses.scene.find(fact);
    if (flag.sub.empty() && reading != senses.scene.end()) {
        return reading->second.value;
    }
    const std::string& value = own.value(believed()[index(branch)], digit);
    if (leads && own.value(*leads, digit) != value) {
        return std::nullopt;
    }
    return value;
}

std::optional<bool> LiveRun::truth(
    const std::vector<std::pair<Fact, std::string>>& facts, const std::set<Fact>& left_out,
    const std::map<Fact, std::string>& declared) const {
    bool known = true;
    for (const auto& [fact, wanted] : facts) {
        const std::optional<std::string> value = seen(fact, left_out, declared);
        if (value && *value != wanted) {
            return false;
        }
        known = known && value.has_value();
    }
    return known ? std::optional<bool>(true) : std::nullopt;
}

std::vector<Hazard> LiveRun::met() {
    std::vector<Hazard> found;
    std::set<std::string> names;
    for (const Hazard& hazard : blueprint.hazards) {
        if (truth(hazard.facts, transit, {}).value_or(false)) {
            found.push_back(hazard);
            names.insert(hazard.name);
        }
    }
    std::set<std::string> still;
    std::set_intersection(
        told_hazards.begin(), told_hazards.end(), names.begin(), names.end(),
        std::inserter(still, still.end()));
    told_hazards = still;
    return found;
}

void LiveRun::tell_hazards(const std::vector<Hazard>& hazards) {
    for (const Hazard& hazard : hazards) {
        told_hazards.insert(hazard.name);
        std::vector<std::pair<std::string, std::string>> facts;
        for (const auto& [fact, value] : hazard.facts) {
            facts.emplace_back(blueprint.fact_text(fact), value);
        }
        tell(event("hazard_met").text("name", hazard.name).raw("facts", json_map(facts)));
    }
}

std::string LiveRun::hazard_facts(const Hazard& hazard) const {
    std::vector<std::string> found;
    for (const auto& [fact, value] : hazard.facts) {
        found.push_back(blueprint.fact_text(fact) + " is " + value);
    }
    return joined(found, ", ");
}

std::vector<std::string> LiveRun::met_words(const std::vector<Hazard>& hazards) const {
    std::vector<std::string> found;
    for (const Hazard& hazard : hazards) {
        found.push_back("the hazard " + hazard.name + " is met: " + hazard_facts(hazard));
    }
    return found;
}

// The facts now and after each action, as far as the actions declare them.
LiveRun::Moments LiveRun::moments(
    const std::vector<Action>& actions, std::set<Fact>& changed) const {
    Moments found{{transit, {}}};
    Declared declared;
    Configuration here = believed();
    for (const Action& action : actions) {
        for (const auto& [branch, state] : action.moved.all) {
            const Branch& own = hierarchy.of(branch);
            for (int digit = 0; digit < static_cast<int>(own.flags.size()); ++digit) {
                declared[Fact{branch, digit}] = own.value(state, digit);
            }
            const std::set<Fact> differ = differing(branch, here[index(branch)], state);
            changed.insert(differ.begin(), differ.end());
            here[index(branch)] = state;
        }
        found.emplace_back(action.after, declared);
    }
    return found;
}

// The unknown facts that could complete a hazard at some moment, if the actions change one of its
// facts.
std::vector<Fact> LiveRun::unknown_of(
    const Hazard& hazard, const Moments& all, const std::set<Fact>& changed) const {
    std::vector<Fact> unknown;
    const bool changes = std::any_of(
        hazard.facts.begin(), hazard.facts.end(),
        [&](const auto& one) { return changed.count(one.first) > 0; });
    for (const auto& [left_out, said] : all) {
        if (changes && unknown.empty() && !truth(hazard.facts, left_out, said)) {
            for (const auto& one : hazard.facts) {
                if (!seen(one.first, left_out, said)) {
                    unknown.push_back(one.first);
                }
            }
        }
    }
    return unknown;
}

std::vector<Fact> LiveRun::doubtful(const std::vector<Action>& actions) const {
    std::vector<Fact> found;
    std::set<Fact> changed;
    const Moments all = moments(actions, changed);
    for (const Hazard& hazard : blueprint.hazards) {
        const std::vector<Fact> unknown = unknown_of(hazard, all, changed);
        found.insert(found.end(), unknown.begin(), unknown.end());
    }
    return found;
}

std::optional<Objection> LiveRun::objection(
    const std::string& asked, const std::vector<Action>& actions) const {
    std::set<Fact> changed;
    const Moments all = moments(actions, changed);
    for (std::size_t at = 1; at < all.size(); ++at) {
        for (const Hazard& hazard : blueprint.hazards) {
            if (truth(hazard.facts, all[at].first, all[at].second).value_or(false)) {
                return Objection{
                    hazard.name, asked + " would meet the hazard " + hazard.name + ": " +
                                     hazard_facts(hazard)};
            }
        }
    }
    for (const Hazard& hazard : blueprint.hazards) {
        std::vector<std::string> unknown;
        for (const Fact& fact : unknown_of(hazard, all, changed)) {
            unknown.push_back(blueprint.fact_text(fact));
        }
        if (!unknown.empty()) {
            return Objection{
                hazard.name, asked + " changes a fact of the hazard " + hazard.name + ", and " +
                                 joined(unknown, ", ") + " is unknown"};
        }
    }
    return std::nullopt;
}

// effects -------------------------------------------------------------------------------------------

std::set<Fact> LiveRun::differing(int branch, int source, int target) const {
    std::set<Fact> found;
    const Branch& own = hierarchy.of(branch);
    for (int digit = 0; digit < static_cast<int>(own.flags.size()); ++digit) {
        if (own.value(source, digit) != own.value(target, digit)) {
            found.emplace(branch, digit);
        }
    }
    return found;
}

std::set<Fact> LiveRun::changed_by(const Action& action) const {
    std::set<Fact> found;
    for (const int digit : action.edge->terms->touches) {
        found.emplace(action.edge->branch, digit);
    }
    const Configuration all = believed();
    for (const auto& [branch, state] : action.targets().all) {
        const std::set<Fact> differ = differing(branch, all[index(branch)], state);
        found.insert(differ.begin(), differ.end());
    }
    return found;
}

std::set<Fact> LiveRun::touched(
    const std::vector<Action>& begun, const std::set<std::string>& still_open) const {
    std::set<Fact> found;
    const auto add = [&](const std::set<Fact>& facts) {
        for (const Fact& fact : facts) {
            if (blueprint.flag(fact).sub.empty()) {
                found.insert(fact);
            }
        }
    };
    for (const Action& action : begun) {
        for (const Edge* edge : action.begins) {
            if (still_open.count(edge->address)) {
                add(differing(edge->branch, edge->source, edge->target));
                for (const int digit : edge->acts ? edge->terms->touches : std::vector<int>{}) {
                    found.emplace(edge->branch, digit);
                }
            }
        }
        if (action.edge->load && still_open.count(action.edge->address)) {
            for (const auto& [branch, state] : action.targets().all) {
                add(differing(branch, configuration[index(branch)], state));
            }
        }
    }
    return found;
}

std::set<int> LiveRun::moved_by(const Edge& edge) const {
    std::set<int> found{edge.branch};
    if (edge.load) {
        for (const std::vector<int>& digits : {edge.falls, edge.rises}) {
            for (const int digit : digits) {
                const std::vector<int> below =
                    hierarchy.tree(hierarchy.sub_at(edge.branch, digit));
                found.insert(below.begin(), below.end());
            }
        }
    }
    return found;
}

}  // namespace dsfo
