#include "needed.hpp"

#include <algorithm>

namespace dsfo {

namespace {

bool is_unknown(const LiveRun& run, Fact fact) {
    const auto reading = run.senses.scene.find(fact);
    return reading != run.senses.scene.end() && !reading->second.value;
}

// For the unknown facts that terms depend on and people may tell, in order.
std::vector<Question> questions(const LiveRun& run, const std::vector<Term>& terms) {
    std::vector<Question> found;
    std::set<Fact> met;
    std::vector<Term> waiting(terms.rbegin(), terms.rend());
    while (!waiting.empty()) {
        const Term term = waiting.back();
        waiting.pop_back();
        if (term.reason == in_transit || !met.insert(term.fact).second) {
            continue;
        }
        if (!run.blueprint.flag(term.fact).sub.empty()) {
            const int sub = run.hierarchy.sub_at(term.fact.first, term.fact.second);
            const Check inner = run.check(sub, run.hierarchy.of(sub).activating);
            const std::vector<Term> unknown = inner.unknown();
            waiting.insert(waiting.end(), unknown.rbegin(), unknown.rend());
        } else if (run.levels.fact(term.fact) != "automatic" && is_unknown(run, term.fact)) {
            found.push_back(fact_task(run.hierarchy, term.fact));
        }
    }
    return found;
}

}  // namespace

std::vector<Question> needed_in(const LiveRun& run, const std::vector<Check>& checks) {
    std::vector<Term> terms;
    for (const Check& check : checks) {
        if (!check.truth()) {
            const std::vector<Term> unknown = check.unknown();
            terms.insert(terms.end(), unknown.begin(), unknown.end());
        }
    }
    return questions(run, terms);
}

std::vector<Question> needed_of(const LiveRun& run, const JointStep& step) {
    std::vector<Term> terms;
    std::vector<Term> required;
    std::set<int> left;
    for (const Edge* edge : step.edges) {
        const std::vector<Term> its = run.needs(*edge);
        required.insert(required.end(), its.begin(), its.end());
        const int now = run.configuration[static_cast<std::size_t>(edge->branch)];
        if (left.insert(edge->branch).second && edge->source == now) {
            const Check check = run.check(edge->branch, edge->source);
            if (!check.truth().value_or(true)) {
                return {};
            }
            const std::vector<Term> unknown = check.unknown();
            terms.insert(terms.end(), unknown.begin(), unknown.end());
        }
    }
    for (const Term& term : required) {
        if (!term.truth.value_or(true)) {
            return {};
        }
        if (!term.truth) {
            terms.push_back(term);
        }
    }
    for (const Fact& fact : run.doubtful(step.actions)) {
        terms.push_back(Term{fact, "", std::nullopt, std::nullopt, ""});
    }
    return questions(run, terms);
}

std::vector<Question> needed_everywhere(const LiveRun& run) {
    std::vector<Question> found;
    for (const auto& [fact, reading] : run.senses.scene) {
        if (!reading.value && run.levels.fact(fact) != "automatic") {
            found.push_back(fact_task(run.hierarchy, fact));
        }
    }
    return found;
}

bool all_theirs(const LiveRun& run, const std::vector<Term>& terms) {
    return std::all_of(terms.begin(), terms.end(), [&run](const Term& term) {
        return !term.truth && !questions(run, {term}).empty();
    });
}

}  // namespace dsfo
