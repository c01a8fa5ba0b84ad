#include "disturbance.hpp"

#include <algorithm>
#include <cmath>

#include "log.hpp"

namespace dsfo {

namespace {

constexpr double hair = 1e-9;

struct Parameter {
    std::string name;
    double usual = 0.0;
};

const std::map<std::string, Parameter>& parameters() {
    static const std::map<std::string, Parameter> known{
        {"stuck", {"value", 0.0}},  {"drift", {"every", 1.0}},    {"noise", {"rate", 0.1}},
        {"dropout", {"rate", 1.0}}, {"delay", {"seconds", 0.1}}, {"none", {"", 0.0}}};
    return known;
}

}  // namespace

Disturbance disturbance_of(
    const std::string& kind, const std::map<std::string, Json>& given, std::string& wrong) {
    const auto known = parameters().find(kind);
    if (known == parameters().end()) {
        wrong = "there is no disturbance '" + kind + "'";
        return {};
    }
    const Parameter& own = known->second;
    Disturbance found{kind, own.usual, std::nullopt};
    for (const auto& [name, value] : given) {
        if (own.name.empty() || name != own.name) {
            wrong = "the disturbance " + kind + " has no '" + name + "'";
        } else if (kind == "stuck") {
            found.value = value.text;
            if (value.kind != Json::Kind::text) {
                wrong = "a sensor is stuck at a text";
            }
        } else {
            const double most = own.name == "rate" ? 1.0 : 1e6;
            found.number = value.number;
            if (value.kind != Json::Kind::number || found.number < 0.0 || found.number > most ||
                (kind == "drift" && found.number <= 0.0)) {
                wrong = own.name + " of " + kind + " is no number from " +
                        (kind == "drift" ? "above 0" : "0") + " to " + plain_number(most);
            }
        }
    }
    return found;
}

void DisturbedSensor::begin(const Disturbance& what) {
    ++begun_;
    if (what.kind == "none") {
        kinds_.clear();
        delay_ = 0.0;
    } else if (what.kind == "delay") {
        delay_ = what.number;
    } else {
        Chance chance(seed_ + " " + what.kind + " " + std::to_string(begun_));
        kinds_.erase(what.kind);
        kinds_.emplace(what.kind, Kind{what, chance, std::nullopt, what.value.has_value()});
    }
}

void DisturbedSensor::take(Sample sample, double now) {
    for (const char* const name : {"stuck", "drift", "noise", "dropout"}) {
        const auto kind = kinds_.find(name);
        if (kind != kinds_.end() && !pass(kind->second, sample)) {
            return;
        }
    }
    held_.emplace_back(now + delay_, sample);
}

std::vector<Sample> DisturbedSensor::release(double now) {
    std::vector<Sample> arrived;
    std::vector<std::pair<double, Sample>> later;
    for (const auto& one : held_) {
        if (one.first <= now + hair) {
            arrived.push_back(one.second);
        } else {
            later.push_back(one);
        }
    }
    held_ = later;
    return arrived;
}

bool DisturbedSensor::pass(Kind& kind, Sample& sample) {
    Disturbance& what = kind.what;
    if (what.kind == "dropout") {
        return kind.chance.part() >= what.number;
    }
    if (what.kind == "stuck") {
        if (!kind.stuck && sample.value) {
            kind.stuck = true;
            what.value = sample.value;
        }
        sample.value = what.value;
        return true;
    }
    const auto at = std::find(values_.begin(), values_.end(), sample.value.value_or(""));
    if (what.kind == "drift") {
        kind.since = kind.since.value_or(sample.time);
        if (sample.value && at != values_.end()) {
            const auto steps = static_cast<std::size_t>(
                (sample.time - *kind.since + hair) / what.number);
            const std::size_t to = static_cast<std::size_t>(at - values_.begin()) + steps;
            sample.value = values_[std::min(to, values_.size() - 1)];
        }
        return true;
    }
    const bool wrong = kind.chance.part() < what.number;
    std::vector<std::string> others;
    std::copy_if(
        values_.begin(), values_.end(), std::back_inserter(others),
        [&sample](const std::string& value) { return value != sample.value; });
    if (wrong && sample.value && !others.empty()) {
        sample.value = others[kind.chance.below(others.size())];
    }
    return true;
}

}  // namespace dsfo
