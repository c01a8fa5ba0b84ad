#include "remote_world.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "log.hpp"

namespace dsfo {

namespace {

constexpr double answer_limit = 5.0;  // seconds
constexpr double open_limit = 60.0;
constexpr double hair = 1e-9;
constexpr std::size_t most_samples = 20000;

bool is_near(double one, double other) {
    return std::abs(one - other) <= hair * std::max(1.0, std::abs(other));
}

}  // namespace

RemoteWorld::RemoteWorld(
    const Hierarchy& hierarchy, std::string address, std::string token, long seed, Hurry hurry)
    : hierarchy_(hierarchy),
      address_(std::move(address)),
      token_(std::move(token)),
      seed_(seed),
      wire_(std::move(hurry)) {}

RemoteWorld::~RemoteWorld() { wire_.close(); }

// opening -------------------------------------------------------------------------------------------

void RemoteWorld::begin(const Configuration& start) {
    const std::string why = open(start);
    if (!why.empty()) {  // nothing moves yet
        lost_ = "the program at " + address_ + " cannot be used: " + why;
        wire_.close();
    }
}

std::string RemoteWorld::open(const Configuration& start) {
    std::string why = wire_.connect(address_);
    if (why.empty()) {
        why = hello();
    }
    Json offer;
    if (why.empty()) {
        why = wire_.ask("open", start_members(start), open_limit, offer);
    }
    if (why.empty() && wire_.declined()) {
        offer.text_of("sentence", why);
        return "it refuses: " + why;
    }
    if (why.empty() && wire_.interrupted()) {
        return "it was stopped before it was open";
    }
    if (why.empty()) {
        why = take_offer(offer);
    }
    Json moment;
    if (why.empty()) {
        why = wire_.ask("sense", "", answer_limit, moment);
    }
    return why.empty() ? take_samples(moment) : why;
}

std::string RemoteWorld::hello() {
    Json card;
    Object said;
    said.count("version", 1).text("token", token_);
    const std::string text = said.str();
    const std::string why =
        wire_.ask("hello", text.substr(1, text.size() - 2), answer_limit, card);
    if (!why.empty()) {
        return why;
    }
    double version = 0.0;
    std::string session;
    bool hardware = false;
    bool wants = false;
    card.flag_of("hardware", hardware);
    card.flag_of("wants_blueprint", wants);
    if (wire_.declined()) {
        card.text_of("sentence", session);
        return "it refuses: " + session;
    }
    if (!card.number_of("version", version) || version != 1.0) {
        return "it speaks another version of the protocol";
    }
    if (!card.text_of("session", session) || session.empty() || session.size() > 100) {
        return "it names no session";
    }
    if (hardware) {
        return "it says that it is hardware, and this program judges no policy";
    }
    if (wants) {
        return "it wants the text of the blueprint; let it serve that file (--file)";
    }
    wire_.name_session(session);
    return "";
}

std::string RemoteWorld::start_members(const Configuration& start) const {
    std::vector<std::pair<std::string, std::string>> states;
    std::vector<std::pair<std::string, std::string>> facts;
    for (const int one : hierarchy_.order) {
        const Branch& branch = hierarchy_.of(one);
        const int state = start[static_cast<std::size_t>(one)];
        states.emplace_back(branch.name, branch.states[static_cast<std::size_t>(state)].name);
        for (int digit = 0; digit < static_cast<int>(branch.flags.size()); ++digit) {
            if (branch.flags[static_cast<std::size_t>(digit)].sub.empty()) {
                facts.emplace_back(
                    hierarchy_.blueprint.fact_text(Fact{one, digit}), branch.value(state, digit));
            }
        }
    }
    Object said;
    said.raw("start", json_map(states)).raw("facts", json_map(facts)).count("seed", seed_);
    said.text("behaviour", hierarchy_.blueprint.behaviour);
    const std::string text = said.str();
    return text.substr(1, text.size() - 2);
}

std::optional<Fact> RemoteWorld::fact_of(const std::string& text) const {
    for (std::size_t at = 0; at < hierarchy_.blueprint.branches.size(); ++at) {
        const std::vector<Flag>& flags = hierarchy_.blueprint.branches[at].flags;
        for (std::size_t digit = 0; digit < flags.size(); ++digit) {
            const Fact fact{static_cast<int>(at), static_cast<int>(digit)};
            if (flags[digit].sub.empty() && hierarchy_.blueprint.fact_text(fact) == text) {
                return fact;
            }
        }
    }
    return std::nullopt;
}

std::string RemoteWorld::take_offer(const Json& offer) {
    offer.number_of("settle", settle_);
    if (!offer.number_of("tick", tick_) || tick_ < 1e-6 || tick_ > 10.0) {
        return "its tick is no time";
    }
    if (settle_ < 0.0 || settle_ > 1000.0) {
        return "its time to settle is no time";
    }
    const std::string why = take_operations(offer);
    return why.empty() ? take_sensors(offer) : why;
}

std::string RemoteWorld::take_operations(const Json& offer) {
    for (const Json& one : offer.list_of("operations")) {
        std::string function;
        if (!one.text_of("function", function) || function.empty()) {
            return "it offers an operation without a name";
        }
        for (const Json& served : one.list_of("serves")) {
            if (served.kind != Json::Kind::text) {
                return "it offers an operation for something that is no name";
            }
            functions_[served.text] = function;
        }
    }
    return "";
}

std::string RemoteWorld::take_sensors(const Json& offer) {
    for (const Json& one : offer.list_of("sensors")) {
        std::string name;
        std::string fact;
        std::string unit;
        Sensor sensor;
        one.text_of("unit", unit);
        one.number_of("max_age", sensor.max_age);
        if (!one.text_of("name", name) || !one.text_of("fact", fact) || sensor.max_age < 0.0) {
            return "it offers a sensor that is none";
        }
        const std::optional<Fact> known = fact_of(fact);
        if (!unit.empty() || !known) {
            unbound_.emplace(fact, name);  // a measure, or no fact of this blueprint
            continue;
        }
        sensor.fact = *known;
        const Flag& flag = hierarchy_.blueprint.flag(*known);
        sensor.values = flag.values;
        sensor.values.insert(sensor.values.end(), flag.failure.begin(), flag.failure.end());
        if (const Json* const words = one.find("words")) {
            sensor.values.insert(
                sensor.values.end(), words->names.begin(), words->names.end());
        }
        if (!sensors_.emplace(std::make_pair(fact, name), sensor).second) {
            return "it offers two sensors of one name";
        }
    }
    return "";
}

// a moment ------------------------------------------------------------------------------------------

void RemoteWorld::step() {
    if (!lost_.empty()) {
        return;
    }
    Json moment;
    std::string why = wire_.ask("tick", "", answer_limit, moment);
    if (why.empty() && wire_.interrupted()) {
        return;  // the stop of a person goes first; the answer comes later, if at all
    }
    if (why.empty() && wire_.declined()) {
        why = "it refuses to go on";
    }
    if (why.empty()) {
        ++ticks_;
        why = take_tick(moment);
    }
    if (!why.empty()) {
        lose(why);
    }
}

std::string RemoteWorld::take_tick(const Json& moment) {
    double told = 0.0;
    std::string word;
    if (!moment.number_of("time", told) || !is_near(told, time())) {
        return "its time is wrong";
    }
    if (!moment.text_of("outcome", word)) {
        return "it does not say what the operation does";
    }
    const std::map<std::string, Outcome> known{
        {"running", Outcome::running}, {"returned", Outcome::returned},
        {"failed", Outcome::failed}, {"raised", Outcome::raised}};
    const auto found = known.find(word);
    if (running_.empty() || outcome_ != Outcome::running) {
        if (word != "idle") {
            return "an operation is " + word + ", and none has begun";
        }
    } else if (found == known.end()) {
        return "it does nothing, and an operation has begun";
    } else {
        outcome_ = found->second;
    }
    return take_samples(moment);
}

std::string RemoteWorld::take_samples(const Json& moment) {
    const Json* const told = moment.find("samples");
    const bool listed = told != nullptr && told->kind == Json::Kind::list;
    if (told != nullptr && (!listed || told->items.size() > most_samples)) {
        return "its samples are no list of at most " + std::to_string(most_samples);
    }
    for (const Json& one : moment.list_of("samples")) {
        std::string name;
        std::string fact;
        std::string quality = "good";
        double at = 0.0;
        double sequence = 0.0;
        if (!one.text_of("sensor", name) || !one.text_of("fact", fact) ||
            !one.number_of("time", at) || !one.number_of("sequence", sequence) ||
            sequence < 0.0 || sequence != std::floor(sequence)) {
            return "a sample is incomplete";
        }
        const bool judged = one.text_of("quality", quality) || one.find("quality") == nullptr;
        if (!judged || (quality != "good" && quality != "uncertain" && quality != "bad")) {
            return "the quality of a sample is no word for one";
        }
        const auto found = sensors_.find({fact, name});
        if (found == sensors_.end()) {
            if (unbound_.count({fact, name})) {
                continue;
            }
            return "a sample is of no sensor that it has offered";
        }
        Sensor& sensor = found->second;
        const Json* const value = one.find("value");
        if (value == nullptr ||
            (value->kind != Json::Kind::text && value->kind != Json::Kind::null)) {
            return "a sample has no value";
        }
        if (at < 0.0 || at > time() + hair * std::max(1.0, time())) {
            return "a sample comes from the future";
        }
        if (sequence <= sensor.sequence) {
            continue;  // it came before
        }
        sensor.sequence = sequence;
        sensor.time = at;
        sensor.value.reset();
        if (value->kind == Json::Kind::text) {
            const auto& values = sensor.values;
            if (std::find(values.begin(), values.end(), value->text) == values.end()) {
                return name + " reads a value that its fact has not";
            }
            if (quality == "good") {
                sensor.value = value->text;
            }
        }
    }
    return "";
}

std::optional<std::string> RemoteWorld::sense(Fact fact) const {
    std::optional<std::string> found;
    for (const auto& [key, sensor] : sensors_) {
        if (sensor.fact != fact) {
            continue;
        }
        const bool fresh = sensor.time >= 0.0 && time() - sensor.time <= sensor.max_age + hair;
        if (!lost_.empty() || !fresh || !sensor.value || (found && *found != *sensor.value)) {
            return std::nullopt;
        }
        found = sensor.value;
    }
    return found;
}

// operations ----------------------------------------------------------------------------------------

Outcome RemoteWorld::carry_out(const Edge& edge) {
    if (!lost_.empty()) {
        return Outcome::failed;
    }
    if (running_ == edge.address) {
        const Outcome now = outcome_;
        if (now != Outcome::running) {
            running_.clear();
        }
        return now;
    }
    auto bound = functions_.find(edge.address);
    if (bound == functions_.end()) {
        bound = functions_.find(edge.name);
    }
    if (bound == functions_.end()) {
        return Outcome::failed;
    }
    Object said;
    said.text("operation", edge.address).text("function", bound->second);
    const std::string text = said.str();
    Json answer;
    const std::string why =
        wire_.ask("begin", text.substr(1, text.size() - 2), answer_limit, answer);
    if (!why.empty() || wire_.declined()) {
        lose(why.empty() ? "it refuses to begin " + edge.address : why);
        return Outcome::failed;
    }
    running_ = edge.address;
    outcome_ = Outcome::running;
    return Outcome::running;
}

void RemoteWorld::brake() {
    running_.clear();
    if (!lost_.empty()) {
        return;
    }
    const bool owed = wire_.interrupted();
    const bool stopped = wire_.stop();
    if (!stopped) {
        end("a stop had no answer", stopped);
    } else if (owed) {  // what it would have said is lost, so its time is not known any more
        end("it was stopped before it had answered", stopped);
    }
}

void RemoteWorld::lose(const std::string& why) { end(why, wire_.stop()); }

void RemoteWorld::end(const std::string& why, bool stopped) {
    lost_ = "the program at " + address_ + " is lost: " + why;
    lost_ += stopped ? ". It acknowledged a stop"
                     : ". It did not acknowledge a stop, so it may still move";
    running_.clear();
    wire_.close();
}

std::string token_in(const std::string& file, std::string& wrong) {
    struct stat about {};
    std::string token;
    if (stat(file.c_str(), &about) != 0 || !(std::ifstream(file) >> token)) {
        wrong = file + ": the token cannot be read";
    } else if ((about.st_mode & 077U) != 0) {
        wrong = file + " can be read by others; say: chmod 600 " + file;
    } else if (token.size() < 16 || token.size() > 200) {
        wrong = file + " has no token: one line of 16 to 200 characters";
    }
    return token;
}

}  // namespace dsfo
