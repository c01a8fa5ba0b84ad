#include "world.hpp"

namespace dsfo {

void TableWorld::begin(const Configuration& start) {
    facts_.clear();
    for (std::size_t at = 0; at < start.size(); ++at) {
        write(static_cast<int>(at), start[at]);
    }
}

std::optional<std::string> TableWorld::sense(Fact fact) const {
    const auto found = facts_.find(fact);
    return found == facts_.end() ? std::nullopt : std::optional<std::string>(found->second);
}

void TableWorld::spoil(
    const std::string& fault, const std::string& at,
    const std::optional<std::pair<int, int>>& elsewhere) {
    fault_ = fault;
    fault_at_ = at;
    elsewhere_ = elsewhere;
}

Outcome TableWorld::spoilt() {
    const std::string fault = fault_;
    fault_.clear();
    if (fault == "elsewhere") {
        write(elsewhere_->first, elsewhere_->second);
    }
    hangs_ = fault == "hang";
    return hangs_ ? Outcome::running
           : fault == "raise" ? Outcome::raised
           : fault == "fail" ? Outcome::failed
                             : Outcome::returned;
}

Outcome TableWorld::carry_out(const Edge& edge) {
    if (hangs_) {
        return Outcome::running;
    }
    if (!fault_.empty() && (fault_at_.empty() || fault_at_ == edge.address)) {
        return spoilt();
    }
    write(edge.branch, edge.target);
    if (edge.load) {
        std::map<int, bool> turned;  // by digit: whether it rises
        for (const int digit : edge.falls) {
            turned[digit] = false;
        }
        for (const int digit : edge.rises) {
            turned[digit] = true;
        }
        for (const auto& [digit, rises] : turned) {
            const int sub = hierarchy_.sub_at(edge.branch, digit);
            for (const auto& [branch, state] :
                 hierarchy_.standing(sub, hierarchy_.rest(sub, rises))) {
                write(branch, state);
            }
        }
    }
    return Outcome::returned;
}

void TableWorld::write(int branch, int state) {
    const Branch& own = hierarchy_.of(branch);
    for (std::size_t digit = 0; digit < own.flags.size(); ++digit) {
        if (own.flags[digit].sub.empty()) {
            const int number = static_cast<int>(digit);
            facts_[Fact{branch, number}] = own.value(state, number);
        }
    }
}

}  // namespace dsfo
