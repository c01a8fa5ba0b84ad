// Who does, senses, inspects and supervises: human, shared or automatic.
#pragma once

#include <set>

#include "hierarchy.hpp"

namespace dsfo {

class Levels {
public:
    // `before` is what a script sets before the start: it counts before what the blueprint says.
    Levels(const Hierarchy& hierarchy, std::map<std::string, std::string> before);

    std::string inspection;
    std::string supervision;

    std::string operation(const Edge& edge) const;
    std::string fact(Fact fact) const;
    bool people_do(int branch) const;  // whether people may carry out or confirm in this SB
    bool by_person(const Edge& edge) const;  // a person does it instead of its function

private:
    std::string level_of(
        const std::vector<std::string>& keys, const std::string& usual) const;

    const Hierarchy& hierarchy_;
    std::map<std::string, std::string> before_;
    std::map<std::string, std::string> declared_;
    std::set<int> people_do_;
};

// Why nothing of this name can have this level; empty if it can.
std::string no_level(
    const Hierarchy& hierarchy, const std::string& key, const std::string& level);

}  // namespace dsfo
