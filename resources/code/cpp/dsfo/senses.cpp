#include "senses.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace dsfo {

namespace {

constexpr double hair = 1e-9;
constexpr double creep = 1e-3;  // how much slower than ours the clock of a sensor may be
constexpr double usual_age = 0.3;  // seconds

std::string tenths(double number) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.1f", number);
    return text.data();
}

}  // namespace

void Source::take(const Sample& sample, double now) {
    if (newest && sample.number <= newest->number) {
        return;
    }
    const double way = now - sample.time;
    const double quickest = quickest_ + creep * (now - received_);
    if (way - std::min(quickest, way) > max_age_ + hair) {
        return;
    }
    quickest_ = std::min(way, quickest);
    received_ = now;
    newest = sample;
    ++counted;
}

Reading Source::reading(double now) const {
    if (!newest) {
        return Reading{std::nullopt, "no reading yet"};
    }
    const double age = now - received_;
    if (age > max_age_ + hair) {
        return Reading{std::nullopt, "no reading for " + tenths(age) + " s"};
    }
    return Reading{newest->value, newest->value ? "" : "no valid reading"};
}

Reading Senses::Sensed::answered(double now) const {
    if (!answer || level == "automatic" || !answer->value) {
        return Reading{std::nullopt, "nobody has answered yet"};
    }
    if (max_age && now - answer->time > *max_age + hair) {
        return Reading{std::nullopt, "the answer is " + tenths(now - answer->time) + " s old"};
    }
    return Reading{answer->value, ""};
}

Reading Senses::Sensed::reading(double now) const {
    if (level == "human") {
        return answered(now);
    }
    const Reading said = source.reading(now);
    if (level == "automatic" || said.value) {
        return said;
    }
    const Reading told = answered(now);
    return told.value ? told : said;
}

Senses::Senses(const Hierarchy& hierarchy, const World& world, const Levels& levels, long seed)
    : hierarchy_(hierarchy), world_(world), seed_(seed) {
    for (const Fact& fact : hierarchy.blueprint.sensed()) {
        const Flag& flag = hierarchy.blueprint.flag(fact);
        const std::string name =
            "table_" + hierarchy.of(fact.first).name + "_" + std::to_string(fact.second);
        Source source(name, flag.max_age.value_or(usual_age));
        const auto age = flag.told_by_people ? flag.max_age : std::nullopt;
        facts_.emplace(fact, Sensed{levels.fact(fact), source, age, std::nullopt});
    }
}

std::optional<std::string> Senses::read(Fact fact) const {
    const Reader reader = hierarchy_.blueprint.flag(fact).read;
    try {
        return reader ? reader(world_, fact) : world_.sense(fact);
    } catch (...) {  // a sensor that fails has no value
        return std::nullopt;
    }
}

void Senses::look(double now) {
    for (auto& [key, fact] : facts_) {
        const Sample sample{read(key), now, ++fact.source.read};
        const auto disturbed = disturbed_.find(key);
        if (disturbed == disturbed_.end()) {
            fact.source.take(sample, now);
        } else {
            disturbed->second.take(sample, now);
        }
    }
    for (auto& [key, disturbed] : disturbed_) {
        for (const Sample& sample : disturbed.release(now)) {
            facts_.at(key).source.take(sample, now);
        }
    }
    update(now);
}

void Senses::answer(Fact fact, const std::string& value, const std::string& who, double now) {
    facts_.at(fact).answer = Answer{who, value, now};
    doubts_.erase(fact);
    update(now);
}

bool Senses::forget(const std::set<Fact>& facts, double now) {
    bool said = false;
    for (const Fact& key : facts) {
        const auto known = facts_.find(key);
        if (known != facts_.end() && known->second.answer && known->second.answer->value) {
            known->second.answer = Answer{"", std::nullopt, now};
            said = true;
        }
    }
    if (said) {
        update(now);
    }
    return said;
}

void Senses::doubt(const std::set<Fact>& facts, const std::string& reason, double now) {
    for (const Fact& key : facts) {
        const auto known = facts_.find(key);
        if (known != facts_.end()) {
            Doubt doubt{reason, now, {}};
            for (const Told& one : sources(known->second, now)) {
                doubt.counted[one.name] = one.count;
            }
            doubts_[key] = doubt;
        }
    }
    update(now);
}

std::vector<Fact> Senses::late(double since, const std::set<Fact>& facts, double now) const {
    std::vector<Fact> found;
    for (const auto& [key, fact] : facts_) {
        if (facts.count(key) && fact.source.reading(now).value &&
            fact.source.newest->time <= since) {
            found.push_back(key);
        }
    }
    return found;
}

std::vector<std::string> Senses::disturb(const std::string& target, const Disturbance& what) {
    std::vector<Fact> found;
    for (const auto& [key, fact] : facts_) {
        if (fact.source.name == target) {
            found.push_back(key);
        }
    }
    const auto named = split_fact(target);
    if (found.empty() && named) {
        const Fact fact{hierarchy_.blueprint.number_of(named->first), named->second};
        if (facts_.count(fact)) {
            found.push_back(fact);
        }
    }
    std::vector<std::string> names;
    for (const Fact& key : found) {
        const std::string& name = facts_.at(key).source.name;
        if (!disturbed_.count(key)) {
            const std::string seed = std::to_string(seed_) + " " +
                                     hierarchy_.blueprint.fact_text(key) + " " + name;
            disturbed_.emplace(
                key, DisturbedSensor(hierarchy_.blueprint.flag(key).values, seed));
        }
        disturbed_.at(key).begin(what);
        names.push_back(name);
    }
    return names;
}

std::vector<Senses::Told> Senses::sources(const Sensed& fact, double now) const {
    const Source& own = fact.source;
    std::vector<Told> found{
        Told{own.name, own.counted, std::nullopt, own.reading(now).value.has_value()}};
    if (own.newest) {
        found.front().read = own.newest->time;
    }
    if (fact.answer && fact.level != "automatic") {
        found.push_back(
            Told{fact.answer->who, 0, std::nullopt, fact.answered(now).value.has_value()});
    }
    return found;
}

void Senses::dispel(double now) {
    for (auto at = doubts_.begin(); at != doubts_.end();) {
        Doubt& doubt = at->second;
        for (const Told& one : sources(facts_.at(at->first), now)) {
            const auto before = doubt.counted.find(one.name);
            const bool early = one.read && *one.read < doubt.since;
            if (before != doubt.counted.end() &&
                (!one.known || (one.count > before->second && !early))) {
                doubt.counted.erase(before);
            }
        }
        at = doubt.counted.empty() ? doubts_.erase(at) : std::next(at);
    }
}

void Senses::update(double now) {
    for (const auto& [key, fact] : facts_) {
        scene[key] = fact.reading(now);
    }
    dispel(now);
    for (const auto& [key, doubt] : doubts_) {
        scene[key] = Reading{std::nullopt, doubt.reason};
    }
}

}  // namespace dsfo
