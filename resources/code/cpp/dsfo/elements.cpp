#include "elements.hpp"

namespace dsfo {

const std::string& Branch::value(int state, int digit) const {
    return states[static_cast<std::size_t>(state)].facts[static_cast<std::size_t>(digit)];
}

bool Branch::is_on(int state, int digit) const {
    return value(state, digit) == flags[static_cast<std::size_t>(digit)].on;
}

std::string Branch::fact_name(int digit) const {
    const std::string& own = flags[static_cast<std::size_t>(digit)].name;
    return own.empty() ? "Fact " + std::to_string(digit + 1) : own;
}

int Branch::number_of(const std::string& state) const {
    for (std::size_t at = 0; at < states.size(); ++at) {
        if (states[at].name == state) {
            return static_cast<int>(at);
        }
    }
    return -1;
}

const Operation& Branch::operation(int state, const std::string& name) const {
    const auto own = operations.find(
        escape(states[static_cast<std::size_t>(state)].name) + "/" + escape(name));
    return own != operations.end() ? own->second : operations.find(escape(name))->second;
}

int Blueprint::number_of(const std::string& branch) const {
    for (std::size_t at = 0; at < branches.size(); ++at) {
        if (branches[at].name == branch) {
            return static_cast<int>(at);
        }
    }
    return -1;
}

const Flag& Blueprint::flag(Fact fact) const {
    const Branch& branch = branches[static_cast<std::size_t>(fact.first)];
    return branch.flags[static_cast<std::size_t>(fact.second)];
}

std::vector<Fact> Blueprint::sensed() const {
    std::vector<Fact> found;
    for (std::size_t at = 0; at < branches.size(); ++at) {
        for (std::size_t digit = 0; digit < branches[at].flags.size(); ++digit) {
            if (branches[at].flags[digit].sub.empty()) {
                found.emplace_back(static_cast<int>(at), static_cast<int>(digit));
            }
        }
    }
    return found;
}

bool Blueprint::meets(const Hazard& hazard, const Configuration& configuration) const {
    for (const auto& [fact, value] : hazard.facts) {
        const auto at = static_cast<std::size_t>(fact.first);
        if (branches[at].value(configuration[at], fact.second) != value) {
            return false;
        }
    }
    return true;
}

std::string Blueprint::fact_text(Fact fact) const {
    const std::string& name = branches[static_cast<std::size_t>(fact.first)].name;
    return escape(name) + "/" + std::to_string(fact.second);
}

std::string escape(const std::string& name) {
    std::string found;
    for (const char one : name) {
        found += one == '~' ? "~0" : one == '/' ? "~1" : std::string(1, one);
    }
    return found;
}

std::string address(const std::vector<std::string>& names) {
    std::vector<std::string> escaped;
    for (const std::string& name : names) {
        escaped.push_back(escape(name));
    }
    return joined(escaped, "/");
}

std::vector<std::string> parts(const std::string& text) {
    std::vector<std::string> found(1);
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool escaped = text[at] == '~' && at + 1 < text.size();
        if (text[at] == '/') {
            found.emplace_back();
        } else if (escaped && (text[at + 1] == '0' || text[at + 1] == '1')) {
            found.back() += text[++at] == '0' ? '~' : '/';
        } else {
            found.back() += text[at];
        }
    }
    return found;
}

std::string joined(const std::vector<std::string>& texts, const std::string& between) {
    std::string found;
    for (std::size_t at = 0; at < texts.size(); ++at) {
        found += (at ? between : std::string()) + texts[at];
    }
    return found;
}

std::optional<std::pair<std::string, int>> split_fact(const std::string& text) {
    const std::size_t slash = text.rfind('/');
    const std::string digit = slash == std::string::npos ? "" : text.substr(slash + 1);
    const bool number = !digit.empty() && digit.size() < 7 &&
                        digit.find_first_not_of("0123456789") == std::string::npos;
    if (!number || slash == 0) {
        return std::nullopt;
    }
    return std::make_pair(joined(parts(text.substr(0, slash)), "/"), std::stoi(digit));
}

}  // namespace dsfo
