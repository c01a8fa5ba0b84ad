#include "steps.hpp"

#include <algorithm>
#include <cmath>

#include "search.hpp"

namespace dsfo {

namespace {

std::size_t index(int number) { return static_cast<std::size_t>(number); }

constexpr std::size_t most_carried = 5000;
constexpr std::size_t most_work = 6000000;

bool has(const std::vector<int>& digits, int digit) {
    return std::find(digits.begin(), digits.end(), digit) != digits.end();
}

// A rise or a fall alone costs what its sub-SB costs.
double own_cost(const Edge& edge) {
    const bool single = edge.kind == Kind::rise || edge.kind == Kind::fall;
    return single && !edge.acts ? 0.0 : edge.price;
}

std::vector<int> both(const std::vector<int>& falls, const std::vector<int>& rises) {
    std::vector<int> found = falls;
    found.insert(found.end(), rises.begin(), rises.end());
    return found;
}

}  // namespace

double rounded(double cost) { return std::nearbyint(cost * 1e9) / 1e9; }

// places ------------------------------------------------------------------------------------------

void Places::put(int branch, int state) {
    for (auto& one : all) {
        if (one.first == branch) {
            one.second = state;
            return;
        }
    }
    all.emplace_back(branch, state);
}

void Places::put_all(const Places& other) {
    for (const auto& [branch, state] : other.all) {
        put(branch, state);
    }
}

void Places::apply(Configuration& configuration) const {
    for (const auto& [branch, state] : all) {
        configuration[index(branch)] = state;
    }
}

std::optional<int> Places::at(int branch) const {
    for (const auto& one : all) {
        if (one.first == branch) {
            return one.second;
        }
    }
    return std::nullopt;
}

Places Action::targets() const {
    Places found = moved;
    found.put_all(committed);
    return found;
}

std::vector<std::string> JointStep::names(int branch) const {
    std::vector<std::string> found;
    for (const Edge* edge : edges) {
        if (edge->branch == branch) {
            found.push_back(edge->name);
        }
    }
    return found;
}

// edges -------------------------------------------------------------------------------------------

Edges::Edges(const Hierarchy& hierarchy) : hierarchy_(hierarchy) {
    const std::vector<Branch>& branches = hierarchy.blueprint.branches;
    out_.resize(branches.size());
    for (std::size_t branch = 0; branch < branches.size(); ++branch) {
        out_[branch].resize(branches[branch].states.size());
        for (std::size_t state = 0; state < branches[branch].states.size(); ++state) {
            for (const auto& [name, target] : branches[branch].states[state].operations) {
                out_[branch][state].push_back(
                    made(static_cast<int>(branch), static_cast<int>(state), name, target));
            }
        }
    }
}

const std::vector<Edge>& Edges::out(int branch, int state) const {
    return out_[index(branch)][index(state)];
}

const Edge* Edges::find(const std::string& address) const {
    const std::vector<std::string> names = parts(address);
    const int branch = names.size() == 3 ? hierarchy_.blueprint.number_of(names[0]) : -1;
    const int state = branch < 0 ? -1 : hierarchy_.of(branch).number_of(names[1]);
    if (state >= 0) {
        for (const Edge& edge : out(branch, state)) {
            if (edge.name == names[2]) {
                return &edge;
            }
        }
    }
    return nullptr;
}

double Edges::price(const std::string& address) const {
    const Edge* const edge = find(address);
    return edge == nullptr ? 0.0 : edge->price;
}

void Edges::set_price(const std::string& address, double price) {
    const Edge* const known = find(address);
    if (known != nullptr) {
        for (Edge& edge : out_[index(known->branch)][index(known->source)]) {
            if (edge.address == address) {
                edge.price = price;
                edge.cost = own_cost(edge);
            }
        }
    }
}

Edge Edges::made(int branch, int source, const std::string& name, int target) const {
    const Branch& own = hierarchy_.of(branch);
    Edge edge;
    edge.branch = branch;
    edge.source = source;
    edge.target = target;
    edge.name = name;
    edge.address = dsfo::address(
        {own.name, own.states[index(source)].name, name});
    edge.terms = &own.operation(source, name);
    bool others = false;
    for (int digit = 0; digit < static_cast<int>(own.flags.size()); ++digit) {
        const bool sub = !own.flags[index(digit)].sub.empty();
        const bool was = own.is_on(source, digit);
        const bool is = own.is_on(target, digit);
        if (sub && was && !is) {
            edge.falls.push_back(digit);
        } else if (sub && !was && is) {
            edge.rises.push_back(digit);
        }
        others = others || (!sub && own.value(source, digit) != own.value(target, digit));
    }
    const std::size_t turned = edge.falls.size() + edge.rises.size();
    edge.kind = turned == 0              ? Kind::pure
                : turned > 1 || others ? Kind::mixed
                : edge.rises.empty()     ? Kind::fall
                                         : Kind::rise;
    edge.load = edge.terms->load && turned > 0;
    edge.acts = edge.load || edge.kind == Kind::pure || others;
    edge.price = edge.terms->cost;
    edge.cost = own_cost(edge);
    if (!hierarchy_.bases[index(branch)].empty()) {
        edge.crossing = static_cast<int>(target == own.activating) -
                        static_cast<int>(source == own.activating);
    }
    edge.needs = required(*edge.terms);
    if (own.states[index(source)].fails.empty()) {
        edge.fails = own.states[index(target)].fails;
    }
    return edge;
}

std::vector<Requirement> Edges::required(const Operation& terms) const {
    std::vector<Requirement> found;
    for (const auto& [key, value] : terms.requires_facts) {
        Requirement one{key, Fact{-1, -1}, value, false};
        const std::size_t slash = key.rfind('/');
        const std::string digit = slash == std::string::npos ? "" : key.substr(slash + 1);
        const bool number = !digit.empty() && digit.size() < 7 &&
                            digit.find_first_not_of("0123456789") == std::string::npos;
        const int branch =
            number ? hierarchy_.blueprint.number_of(parts(key.substr(0, slash))[0]) : -1;
        if (branch >= 0 &&
            std::stoul(digit) < hierarchy_.of(branch).flags.size()) {
            one.fact = Fact{branch, std::stoi(digit)};
            one.known = true;
        }
        found.push_back(one);
    }
    return found;
}

std::vector<std::string> Edges::missing(const Edge& edge, const Configuration& here) const {
    std::vector<std::string> found;
    for (const Requirement& need : edge.needs) {
        if (!need.known) {
            found.push_back(edge.address + " requires " + need.key + ", which is no fact");
            continue;
        }
        const auto [branch, digit] = need.fact;
        const std::string& held = hierarchy_.of(branch).value(here[index(branch)], digit);
        if (held != need.value) {
            found.push_back(
                edge.address + " requires " + hierarchy_.of(branch).name + "/" +
                std::to_string(digit) + " to be " + need.value + ", and it is " + held);
        }
    }
    return found;
}

std::set<int> Edges::requiring(int branch) const {
    std::set<int> found;
    for (const auto& [name, terms] : hierarchy_.of(branch).operations) {
        (void)name;
        for (const Requirement& need : required(terms)) {
            if (need.known) {
                found.insert(need.fact.first);
            }
        }
    }
    return found;
}

// a step that is being written ----------------------------------------------------------------------

struct Carried {
    const Edge* edge = nullptr;
    int first = 0;
    std::vector<Fact> transit;
    int done = -1;
    int order = -1;
    Places places;
    std::size_t group = 0;
};

class Draft {
public:
    explicit Draft(Configuration start) : configuration(std::move(start)) {}

    Carried* begin(const Edge& edge, std::vector<Fact> transit) {
        carried.push_back(std::make_unique<Carried>());
        Carried* one = carried.back().get();
        one->edge = &edge;
        one->first = static_cast<int>(functions.size());
        one->transit = std::move(transit);
        cost += edge.cost;
        return one;
    }

    int run(const Edge& edge) {
        functions.push_back(&edge);
        return static_cast<int>(functions.size()) - 1;
    }

    void finish(Carried& one, int done, const Places& places) {
        one.order = finished_++;
        one.done = done;
        one.places = places;
        places.apply(configuration);
    }

    int last_crossing(const Carried& base) const {
        int found = 0;
        for (const auto& [one, other] : links) {
            if (other == &base && one != &base) {
                found = std::max(found, one->done);
            }
        }
        return found;
    }

    StepPointer step() const;

    Configuration configuration;
    std::vector<std::unique_ptr<Carried>> carried;
    std::vector<const Edge*> functions;
    std::vector<std::pair<Carried*, Carried*>> links;
    double cost = 0.0;

private:
    std::map<const Carried*, int> commits(const std::vector<Carried*>& done) const;
    int finished_ = 0;
};

// After which action each edge commits. A crossing commits with the edges of its bases. Edges that
// follow in one of their SBs while they are pending commit with them, too.
std::map<const Carried*, int> Draft::commits(const std::vector<Carried*>& done) const {
    std::map<const Carried*, int> ends;
    std::map<const Carried*, std::size_t> group;
    for (std::size_t at = 0; at < carried.size(); ++at) {
        ends[carried[at].get()] = carried[at]->done;
        group[carried[at].get()] = at;
    }
    const auto join = [&](const Carried* one, const Carried* other) {
        const std::size_t mine = group[one];
        const std::size_t theirs = group[other];
        const int last = std::max(ends[one], ends[other]);
        for (const auto& each : carried) {
            std::size_t& its = group[each.get()];
            if (its == mine || its == theirs) {
                its = mine;
                ends[each.get()] = last;
            }
        }
    };
    for (const auto& [crossing, base] : links) {
        join(crossing, base);
    }
    std::map<int, const Carried*> latest;
    for (const Carried* one : done) {
        for (const auto& place : one->places.all) {
            const auto former = latest.find(place.first);
            if (former != latest.end() && ends[former->second] > one->done) {
                join(former->second, one);
            }
            latest[place.first] = one;
        }
    }
    return ends;
}

StepPointer Draft::step() const {
    std::vector<Carried*> done;
    for (const auto& one : carried) {
        done.push_back(one.get());
    }
    std::sort(done.begin(), done.end(), [](const Carried* one, const Carried* other) {
        return std::make_pair(one->done, one->order) < std::make_pair(other->done, other->order);
    });
    const std::map<const Carried*, int> ends = commits(done);
    auto step = std::make_shared<JointStep>();
    step->asked = carried.front()->edge;
    step->cost = rounded(cost);
    for (const auto& one : carried) {
        step->edges.push_back(one->edge);
    }
    for (const Carried* one : done) {
        step->after.put_all(one->places);
    }
    std::map<Fact, int> moving;
    const auto in_transit = [&moving] {
        std::set<Fact> found;
        for (const auto& [fact, count] : moving) {
            if (count > 0) {
                found.insert(fact);
            }
        }
        return found;
    };
    for (int at = 0; at < static_cast<int>(functions.size()); ++at) {
        Action action;
        action.edge = functions[index(at)];
        for (const auto& one : carried) {
            if (one->first == at) {
                action.begins.push_back(one->edge);
                for (const Fact& fact : one->transit) {
                    moving[fact] += ends.at(one.get()) >= at ? 1 : 0;
                }
            }
        }
        action.transit = in_transit();
        for (const Carried* one : done) {
            if (one->done == at) {
                action.moved.put_all(one->places);
            }
            if (ends.at(one) == at) {
                action.commits.push_back(one->edge);
                action.committed.put_all(one->places);
                for (const Fact& fact : one->transit) {
                    moving[fact] -= one->first <= at ? 1 : 0;
                }
            }
        }
        action.after = in_transit();
        step->actions.push_back(action);
    }
    return step;
}

// the stepper ---------------------------------------------------------------------------------------

Stepper::Stepper(
    const Hierarchy& known, const Edges& every, Shut shut, std::set<std::string> failing)
    : hierarchy(known), edges(every), shut_(std::move(shut)), failing_(std::move(failing)) {}

Stepper::~Stepper() = default;

bool Stepper::spend(std::size_t count) {
    std::size_t every = 0;
    for (const Branch& branch : hierarchy.blueprint.branches) {
        for (const State& state : branch.states) {
            every += state.operations.size();
        }
    }
    const std::size_t size = 16 + hierarchy.order.size();
    work_ += (1 + count) * size;
    return work_ <= most_work + 8 * size * every;
}

StepAnswer Stepper::step(const Configuration& configuration, const Edge& edge) {
    const auto key = std::make_pair(configuration, &edge);
    const auto known = steps_.find(key);
    if (known != steps_.end()) {
        return known->second;
    }
    Draft draft(configuration);
    Refusal no = carry(draft, edge, {});
    StepAnswer found;
    if (!no) {
        StepPointer made = draft.step();
        no = hazards_of(configuration, *made);
        found = made;
    }
    if (no) {
        found = *no;
    }
    steps_.emplace(key, found);
    return found;
}

std::vector<std::string> Stepper::closures(const Edge& edge) const {
    std::vector<std::string> found;
    const auto shut = shut_.find(edge.address);
    if (shut != shut_.end()) {
        found.push_back(edge.address + " is " + shut->second);
    }
    if (!edge.fails.empty() && failing_.count(edge.address) == 0) {
        found.push_back(edge.address + " leads into a failure: " + edge.fails);
    }
    return found;
}

bool Stepper::allows(const Configuration& configuration, const Edge& edge) const {
    return !allow(configuration, edge);
}

Stepper::Refusal Stepper::allow(const Configuration& configuration, const Edge& edge) const {
    std::vector<std::string> reasons = closures(edge);
    const std::vector<std::string> missing = edges.missing(edge, configuration);
    reasons.insert(reasons.end(), missing.begin(), missing.end());
    if (reasons.empty()) {
        return std::nullopt;
    }
    return Unavailable{reasons, ""};
}

Stepper::Refusal Stepper::hazards_of(const Configuration& before, const JointStep& step) const {
    Configuration here = before;
    for (const Action& action : step.actions) {
        action.moved.apply(here);
        for (const Hazard& hazard : hierarchy.blueprint.hazards) {
            if (hierarchy.blueprint.meets(hazard, here)) {
                const std::string words =
                    step.asked->address + " would meet the hazard " + hazard.name;
                return Unavailable{{words}, hazard.name};
            }
        }
    }
    return std::nullopt;
}

int Stepper::crossing(const Configuration& here, int sub, int state) const {
    return static_cast<int>(hierarchy.is_active(sub, state)) -
           static_cast<int>(hierarchy.is_active(sub, here[index(sub)]));
}

Stepper::Refusal Stepper::carry(Draft& draft, const Edge& edge, const Held& held) {
    if (Refusal no = allow(draft.configuration, edge)) {
        return no;
    }
    if (draft.carried.size() >= most_carried) {
        return Unavailable{{edge.address + " would take more than 5,000 operations"}, ""};
    }
    Places places;
    if (edge.load) {
        if (Refusal no = loaded(draft.configuration, edge, places)) {
            return no;
        }
    }
    std::vector<const Edge*> others;
    if (Refusal no = along(draft.configuration, edge, places, held, others)) {
        return no;
    }
    std::vector<Fact> transit;
    const auto add = [&](std::vector<Fact>& into, int sub) {
        const std::vector<Fact>& bases = hierarchy.bases[index(sub)];
        into.insert(into.end(), bases.begin(), bases.end());
    };
    if (edge.crossing != 0) {
        add(transit, edge.branch);
    }
    for (const auto& [sub, state] : places.all) {
        if (crossing(draft.configuration, sub, state) != 0) {
            add(transit, sub);
        }
    }
    std::vector<Carried*> fresh{draft.begin(edge, transit)};
    for (const Edge* other : others) {
        std::vector<Fact> its;
        if (other->crossing != 0) {
            add(its, other->branch);
        }
        fresh.push_back(draft.begin(*other, its));
    }
    Held inner = held;
    for (Carried* one : fresh) {
        inner[one->edge->branch] = one;
    }
    std::vector<std::pair<Carried*, int>> crossed;
    for (Carried* one : fresh) {
        if (one->edge->crossing != 0) {
            crossed.emplace_back(one, one->edge->branch);
        }
    }
    for (const auto& place : places.all) {
        crossed.emplace_back(fresh.front(), place.first);
    }
    for (const auto& [one, sub] : crossed) {
        for (const Fact& base : hierarchy.bases[index(sub)]) {
            const auto at = inner.find(base.first);
            if (at != inner.end()) {
                draft.links.emplace_back(one, at->second);
            }
        }
    }
    if (!edge.load) {
        if (Refusal no = drive(draft, edge, inner)) {
            return no;
        }
    }
    int done = edge.acts ? draft.run(edge) : draft.last_crossing(*fresh.front());
    places.put(edge.branch, edge.target);
    draft.finish(*fresh.front(), done, places);
    for (std::size_t at = 1; at < fresh.size(); ++at) {
        const Edge& other = *fresh[at]->edge;
        done = other.acts ? draft.run(other) : done;
        Places its;
        its.put(other.branch, other.target);
        draft.finish(*fresh[at], done, its);
    }
    if (held.empty() && (edge.crossing != 0 || edge.kind != Kind::pure)) {
        std::vector<std::string> names;
        for (const Fact& one : hierarchy.disagreements(draft.configuration)) {
            names.push_back(hierarchy.of(one.first).name + "/" + std::to_string(one.second));
        }
        if (!names.empty()) {
            const std::string& asked = draft.carried.front()->edge->address;
            return Unavailable{
                {asked + " would leave " + joined(names, ", ") + " against its sub-SB"}, ""};
        }
    }
    return std::nullopt;
}

Stepper::Refusal Stepper::along(
    const Configuration& here, const Edge& edge, const Places& places, const Held& held,
    std::vector<const Edge*>& found) const {
    std::vector<std::pair<int, const Edge*>> taken;
    for (const auto& [branch, one] : held) {
        if (branch != edge.branch) {
            taken.emplace_back(branch, one->edge);
        }
    }
    taken.emplace_back(edge.branch, &edge);
    const std::size_t before = taken.size();
    if (edge.crossing != 0) {
        if (Refusal no = take(here, edge.branch, edge.crossing, taken, {})) {
            return no;
        }
    }
    std::set<int> own{edge.branch};
    for (const auto& place : places.all) {
        own.insert(place.first);
    }
    for (const auto& [sub, state] : places.all) {
        const int way = crossing(here, sub, state);
        if (way != 0) {
            if (Refusal no = take(here, sub, way, taken, own)) {
                return no;
            }
        }
    }
    for (std::size_t at = before; at < taken.size(); ++at) {
        found.push_back(taken[at].second);
    }
    return std::nullopt;
}

Stepper::Refusal Stepper::take(
    const Configuration& here, int sub, int way, std::vector<std::pair<int, const Edge*>>& taken,
    const std::set<int>& loaded_ones) const {
    const Kind kind = way > 0 ? Kind::rise : Kind::fall;
    const std::string word = way > 0 ? "rise" : "fall";
    const std::string name = hierarchy.of(sub).name;
    for (const auto& [base, digit] : hierarchy.bases[index(sub)]) {
        if (loaded_ones.count(base)) {
            continue;
        }
        const int at = base;
        const auto known = std::find_if(
            taken.begin(), taken.end(), [at](const auto& one) { return one.first == at; });
        if (known != taken.end()) {
            if (has(way > 0 ? known->second->rises : known->second->falls, digit)) {
                continue;
            }
            return Unavailable{
                {known->second->address + " is no " + word + " of digit " +
                 std::to_string(digit) + " for " + name},
                ""};
        }
        std::vector<const Edge*> singles;
        for (const Edge& edge : edges.out(base, here[index(base)])) {
            if (edge.kind == kind && !edge.load && (has(edge.rises, digit) || has(edge.falls, digit))) {
                singles.push_back(&edge);
            }
        }
        std::sort(singles.begin(), singles.end(), [](const Edge* one, const Edge* other) {
            return std::tie(one->price, one->name) < std::tie(other->price, other->name);
        });
        std::vector<std::string> reasons{
            hierarchy.of(base).name + "/" + hierarchy.of(base).states[index(here[index(base)])].name +
            " has no " + word + " of digit " + std::to_string(digit) + " for " + name +
            " to take along"};
        bool goes = false;
        for (const Edge* edge : singles) {
            auto attempt = taken;
            attempt.emplace_back(base, edge);
            Refusal no = allow(here, *edge);
            if (!no && edge->crossing != 0) {
                no = take(here, base, edge->crossing, attempt, loaded_ones);
            }
            if (!no) {
                taken = attempt;
                goes = true;
                break;
            }
            reasons.insert(reasons.end(), no->reasons.begin(), no->reasons.end());
        }
        if (!goes) {
            return Unavailable{reasons, ""};
        }
    }
    return std::nullopt;
}

Stepper::Refusal Stepper::loaded(const Configuration& here, const Edge& edge, Places& places) const {
    for (const int digit : both(edge.falls, edge.rises)) {
        const int sub = hierarchy.sub_at(edge.branch, digit);
        const int state = hierarchy.rest(sub, has(edge.rises, digit));
        const std::map<int, int> found = hierarchy.standing(sub, state);
        for (const int one : hierarchy.tree(sub)) {
            places.put(one, found.at(one));
        }
    }
    for (const auto& [branch, state] : places.all) {
        const Branch& own = hierarchy.of(branch);
        const std::string& fails = own.states[index(state)].fails;
        if (!fails.empty() && own.states[index(here[index(branch)])].fails.empty()) {
            return Unavailable{
                {edge.address + " loads " + own.name + " into a failure: " + fails}, ""};
        }
    }
    return std::nullopt;
}

Stepper::Refusal Stepper::drive(Draft& draft, const Edge& edge, const Held& held) {
    for (const int digit : both(edge.falls, edge.rises)) {
        const int sub = hierarchy.sub_at(edge.branch, digit);
        const int goal = hierarchy.rest(sub, has(edge.rises, digit));
        if (draft.configuration[index(sub)] == goal) {
            continue;
        }
        const Route route = sub_route(draft.configuration, sub, goal, held);
        if (const auto* no = std::get_if<Unavailable>(&route)) {
            return *no;
        }
        for (const Edge* part : std::get<std::vector<const Edge*>>(route)) {
            if (Refusal no = carry(draft, *part, held)) {
                return no;
            }
        }
    }
    return std::nullopt;
}

std::vector<int> Stepper::region(int sub, const Held& held, std::vector<int>& border) const {
    const std::vector<int> below = hierarchy.tree(sub);
    std::set<int> moving(below.begin(), below.end());
    std::vector<int> waiting = below;
    std::set<int> around;
    while (!waiting.empty()) {
        const int next = waiting.back();
        waiting.pop_back();
        for (const Fact& base : hierarchy.bases[index(next)]) {
            if (held.count(base.first)) {
                around.insert(base.first);
            } else if (moving.insert(base.first).second) {
                waiting.push_back(base.first);
            }
        }
    }
    std::set<int> seen = moving;
    for (const int one : moving) {
        const std::set<int> asked = edges.requiring(one);
        seen.insert(asked.begin(), asked.end());
    }
    border.assign(around.begin(), around.end());
    std::vector<int> found;
    for (const int one : hierarchy.order) {
        if (seen.count(one)) {
            found.push_back(one);
        }
    }
    return found;
}

Stepper::Route Stepper::sub_route(
    const Configuration& here, int sub, int goal, const Held& held) {
    std::vector<int> border;
    const std::vector<int> names = region(sub, held, border);
    std::vector<int> key{sub, goal, static_cast<int>(names.size())};
    for (const int one : names) {
        key.push_back(one);
        key.push_back(here[index(one)]);
    }
    for (const int base : border) {
        const Edge& edge = *held.at(base)->edge;
        key.push_back(base);
        key.push_back(static_cast<int>(edge.rises.size()));
        key.insert(key.end(), edge.rises.begin(), edge.rises.end());
        key.insert(key.end(), edge.falls.begin(), edge.falls.end());
    }
    const auto known = routes_.find(key);
    if (known != routes_.end()) {
        return known->second;
    }
    return routes_.emplace(key, search(here, sub, goal, held)).first->second;
}

Stepper::Route Stepper::search(const Configuration& here, int sub, int goal, const Held& held) {
    std::vector<int> border;
    const std::vector<int> names = region(sub, held, border);
    const int way = hierarchy.is_active(sub, goal) ? 1 : -1;
    std::vector<std::string> reasons;
    const auto moves = [&](const Configuration& node, std::vector<Move>& found) {
        Configuration now = here;
        for (std::size_t at = 0; at < names.size(); ++at) {
            now[index(names[at])] = node[at];
        }
        const std::vector<Edge>& every = edges.out(sub, now[index(sub)]);
        for (const Edge& edge : every) {
            if (edge.crossing != 0 && edge.crossing != way) {
                continue;
            }
            Draft draft(now);
            if (Refusal no = carry(draft, edge, held)) {
                for (const std::string& reason : no->reasons) {
                    if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
                        reasons.push_back(reason);
                    }
                }
                continue;
            }
            Move move;
            for (const int one : names) {
                move.to.push_back(draft.configuration[index(one)]);
            }
            move.cost = rounded(draft.cost);
            move.number = 1;
            move.key = {0, edge.name};
            move.what = &edge;
            found.push_back(move);
        }
        return spend(every.size());
    };
    Configuration start;
    std::size_t at = 0;
    for (const int one : names) {
        at = one == sub ? start.size() : at;
        start.push_back(here[index(one)]);
    }
    const auto is_goal = [at, goal](const Configuration& node) { return node[at] == goal; };
    const Found found = cheapest(
        start, is_goal, moves, patience(hierarchy.blueprint),
        [](const Configuration&) { return 0.0; });
    if (!found.any) {
        const Branch& own = hierarchy.of(sub);
        reasons.insert(
            reasons.begin(), "no permitted way leads " + own.name + " from " +
                                 own.states[index(here[index(sub)])].name + " to " +
                                 own.states[index(goal)].name);
        return Unavailable{reasons, ""};
    }
    std::vector<const Edge*> route;
    for (const Move& move : found.moves) {
        route.push_back(move.what);
    }
    return route;
}

}  // namespace dsfo
