#include "run_header.hpp"

#include <unistd.h>

#include <array>

#include "addresses.hpp"

namespace dsfo {

namespace {

std::vector<std::string> texts(const Hierarchy& hierarchy, const std::map<int, int>& states) {
    std::vector<std::string> found;
    for (const auto& [branch, state] : states) {
        const Branch& own = hierarchy.of(branch);
        found.push_back(address({own.name, own.states[static_cast<std::size_t>(state)].name}));
    }
    return found;
}

std::string supervisor_of(const Hierarchy& hierarchy, const Terms& terms) {
    if (terms.supervisor != nullptr) {
        return terms.supervisor->name();
    }
    const bool agent = Levels(hierarchy, terms.levels).supervision == "automatic";
    return agent ? RiskLimit().name() : "";
}

}  // namespace

std::string header_of(
    const Hierarchy& hierarchy, const World& world, const Terms& terms,
    const Script& script) {
    std::array<char, 256> node{};
    gethostname(node.data(), node.size() - 1);
    Object said;
    said.text("log", "smsl-run").count("version", 3).text("wall_time", now());
    said.text("node", node.data()).count("process", static_cast<long>(getpid()));
    said.text("world", world.name()).count("seed", terms.seed).text("host", "local");
    said.raw("start", json_list(texts(hierarchy, terms.start)));
    said.raw("goals", json_list(texts(hierarchy, terms.goals)));
    said.raw("avoid", json_list(terms.avoid));
    said.text("on_mismatch", terms.adopts ? "adopt" : "hold");
    const std::vector<std::pair<std::string, std::string>> levels(
        terms.levels.begin(), terms.levels.end());
    Object file;
    file.text("file", script.file).text("digest", script.digest);
    said.raw("by_hand", "false").raw("attended", terms.attended ? "true" : "false");
    said.raw("levels", json_map(levels));
    said.raw("script", script.file.empty() ? "null" : file.str());
    said.text("supervisor", supervisor_of(hierarchy, terms));
    said.raw("policy", "null").raw("mqtt", "null");
    const std::string own = said.str();
    return own.substr(0, own.size() - 1) + "," + hierarchy.blueprint.identity + "}";
}

}  // namespace dsfo
