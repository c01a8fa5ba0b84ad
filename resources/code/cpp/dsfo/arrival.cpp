#include <algorithm>

#include "driver.hpp"

namespace dsfo {

namespace {

constexpr double hair = 1e-9;

std::size_t index(int number) { return static_cast<std::size_t>(number); }

}  // namespace

// The goals in order, up to the first one at which the run does not stand.
std::vector<Goal> Arrival::reached() const {
    std::vector<Goal> found;
    for (const Goal& goal : driver_.course.goals) {
        if (driver_.run.configuration[index(goal.first)] != goal.second) {
            break;
        }
        found.push_back(goal);
    }
    return found;
}

bool Arrival::open() const {
    const std::vector<Goal> here = reached();
    return here.size() == driver_.course.goals.size() ||
           std::any_of(here.begin(), here.end(), [this](const Goal& goal) {
               return told_.count(goal) == 0;
           });
}

void Arrival::begin(bool by_move) {
    moved = moved || by_move;
    if (by_move || !since_) {
        since_ = driver_.run.time();
    }
}

// Tells the goals after a tick if the check is true, and holds if it is not.
void Arrival::look() {
    LiveRun& run = driver_.run;
    if (!since_) {
        return;
    }
    const double since = *since_;
    run.look();
    if (driver_.lost()) {
        return;
    }
    const std::vector<Goal> here = reached();
    const bool doubtful = std::any_of(here.begin(), here.end(), [&run](const Goal& goal) {
        return !run.check(goal.first, goal.second).is_true();
    });
    if (closing && here.size() < driver_.course.goals.size()) {
        driver_.finish(
            "held", "The goals do not hold any more, and nobody is there to decide.");
    } else if (doubtful || !run.broken().empty()) {
        if (run.time() - since >= run.world.settle() - hair) {
            forget();
            Driver& driver = driver_;
            driver.informed([&driver, here] { driver.hold(driver.trouble.unconfirmed(here)); });
        }
    } else {
        const std::vector<Fact> late = run.senses.late(since, facts_of(here), run.time());
        driver_.sentence.clear();
        if (late.empty()) {
            tell(here);
        } else {
            driver_.sentence = "A goal awaits a new reading of " +
                               run.blueprint.fact_text(late.front()) + ".";
        }
    }
}

void Arrival::tell(const std::vector<Goal>& here) {
    bool fresh = false;
    std::vector<std::string> names;
    for (const Goal& goal : here) {
        names.push_back(goal_text(driver_.run.hierarchy, goal));
        if (told_.insert(goal).second) {
            fresh = true;
            driver_.run.tell(driver_.run.event("goal_reached").text("goal", names.back()));
        }
    }
    const bool by_move = moved || fresh;
    moved = false;
    since_.reset();
    const bool whole = here.size() == driver_.course.goals.size();
    const std::string words =
        whole ? joined(names, ", ") + (names.size() == 1 ? " holds." : " hold.") : "";
    driver_.arrived(fresh, by_move, words);
}

// The facts that these goals depend on, and all critical facts.
std::set<Fact> Arrival::facts_of(const std::vector<Goal>& goals) const {
    const Hierarchy& hierarchy = driver_.run.hierarchy;
    std::set<int> names;
    for (const Goal& goal : goals) {
        names.insert(goal.first);
    }
    for (std::size_t at = 0; at < hierarchy.blueprint.branches.size(); ++at) {
        for (const Flag& flag : hierarchy.blueprint.branches[at].flags) {
            if (flag.critical) {
                names.insert(static_cast<int>(at));
            }
        }
    }
    std::set<Fact> found;
    for (const int name : names) {
        for (const int below : hierarchy.tree(name)) {
            for (std::size_t digit = 0; digit < hierarchy.of(below).flags.size(); ++digit) {
                found.emplace(below, static_cast<int>(digit));
            }
        }
    }
    return found;
}

}  // namespace dsfo
