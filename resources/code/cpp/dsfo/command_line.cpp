#include "command_line.hpp"

#include <charconv>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "addresses.hpp"
#include "player.hpp"
#include "record.hpp"
#include "remote_world.hpp"
#include "run_header.hpp"

namespace dsfo {

namespace {

const char* const usage =
    "usage: run [--goal SB/State]... [--start SB/State]... [--avoid ADDRESS]... [--log LOG]\n"
    "           [--script FILE] [--seed NUMBER] [--on-mismatch hold|adopt] [--format text|json]\n"
    "           [--record RECORD] [--blueprint FILE]\n"
    "           [--world table|remote] [--address unix:PATH|HOST:PORT] [--token-file FILE]\n";

volatile std::sig_atomic_t asked_to_stop = 0;

void ask_to_stop(int) { asked_to_stop = 1; }

struct Options {
    std::vector<std::string> goals;
    std::vector<std::string> starts;
    std::vector<std::string> avoids;
    std::string log;
    std::string seed = "0";
    std::string mismatch = "hold";
    std::string format = "text";
    std::string world = "table";
    std::string address;
    std::string token_file;
    std::string script;
    std::string record;
    std::string blueprint;
    bool help = false;
    std::string wrong;
};

bool is_number(const std::string& text, long& number) {
    const char* last = text.data() + text.size();
    const auto end = std::from_chars(text.data(), last, number);
    return end.ec == std::errc() && end.ptr == last;
}

Options options_of(const std::vector<std::string>& words) {
    Options found;
    const std::map<std::string, std::vector<std::string>*> lists{
        {"--goal", &found.goals}, {"--start", &found.starts}, {"--avoid", &found.avoids}};
    const std::map<std::string, std::string*> single{
        {"--log", &found.log}, {"--seed", &found.seed}, {"--on-mismatch", &found.mismatch},
        {"--format", &found.format}, {"--world", &found.world},
        {"--address", &found.address}, {"--token-file", &found.token_file},
        {"--script", &found.script}, {"--record", &found.record},
        {"--blueprint", &found.blueprint}};
    if (words.empty() || words.front() != "run") {
        found.help = !words.empty() && (words.front() == "--help" || words.front() == "-h");
        found.wrong = found.help ? "" : "say what to do: run";
        return found;
    }
    for (std::size_t at = 1; at < words.size(); ++at) {
        const std::size_t equals = words[at].find('=');
        const std::string name = words[at].substr(0, equals);
        const bool list = lists.count(name) > 0;
        if (name == "--help" || name == "-h") {
            found.help = true;
            return found;
        }
        if (name == "--policy") {
            found.wrong = name + " is not for C++: policies are judged by generated Python";
            return found;
        }
        if (!list && !single.count(name)) {
            found.wrong = "there is no " + name;
            return found;
        }
        if (equals == std::string::npos && at + 1 == words.size()) {
            found.wrong = name + " needs a value";
            return found;
        }
        const std::string value =
            equals == std::string::npos ? words[++at] : words[at].substr(equals + 1);
        if (list) {
            lists.at(name)->push_back(value);
        } else {
            *single.at(name) = value;
        }
    }
    long number = 0;
    if (!is_number(found.seed, number)) {
        found.wrong = "--seed is a whole number";
    } else if (found.mismatch != "hold" && found.mismatch != "adopt") {
        found.wrong = "--on-mismatch is hold or adopt";
    } else if (found.format != "text" && found.format != "json") {
        found.wrong = "--format is text or json";
    } else if (found.world != "table" && found.world != "remote") {
        found.wrong = "--world is table or remote";
    } else if ((found.world == "remote") == found.address.empty()) {
        found.wrong = "--world remote and --address belong together";
    }
    return found;
}

int wrong_usage(const std::string& sentence) {
    std::cerr << sentence << "\n" << usage;
    return 2;
}

// The events of a run: to the log first, then to people. Without a log that can be written nothing
// goes on.
class Teller {
public:
    explicit Teller(RunLog* log) : log_(log) {}

    bool tell(const std::vector<std::string>& events, bool last) {
        for (std::size_t at = 0; at < events.size(); ++at) {
            if (log_ != nullptr) {
                log_->write(events[at]);
                if (last && at + 1 == events.size()) {
                    log_->finish();
                }
            }
            std::cout << events[at] << "\n" << std::flush;
        }
        return log_ == nullptr || log_->good();
    }

    static void refuse(const std::string& sentence) { std::cerr << sentence << "\n"; }

private:
    RunLog* log_;
};

// Plays the script, if there is one, until somebody asks the program to stop.
class Played {
public:
    explicit Played(const Script& script) {
        if (!script.acts.empty()) {
            player_ = std::make_unique<Player>(script);
        }
    }

    void before(Dispatcher& dispatcher) {
        if (asked_to_stop) {
            asked_to_stop = 0;
            player_.reset();
            dispatcher.stop();
            dispatcher.leave();
        } else if (player_) {
            player_->before(dispatcher);
        }
    }

    void hear(const std::vector<std::string>& events) {
        if (player_) {
            player_->hear(events);
        }
    }

    void tell_left(const std::string& file) const {
        for (const Act* act : player_ ? player_->left() : std::vector<const Act*>{}) {
            std::cerr << file << ":" << act->line << ":1: its moment never came: " << act->words()
                      << "\n";
        }
    }

private:
    std::unique_ptr<Player> player_;
};

int carried_out(
    const Hierarchy& hierarchy, World& world, const Terms& terms, const Options& options,
    const Script& script) {
    std::string failed;
    std::unique_ptr<RunLog> log;
    Dispatcher dispatcher(hierarchy, world, terms);
    if (!options.log.empty()) {
        const std::string header = header_of(hierarchy, world, terms, script);
        log = std::make_unique<RunLog>(options.log, header, failed);
    }
    Teller teller(log.get());
    if (!failed.empty()) {
        teller.refuse(failed);
        return failed.rfind("the run log", 0) == 0 ? 1 : 2;
    }
    Played played(script);
    std::signal(SIGINT, ask_to_stop);
    std::signal(SIGTERM, ask_to_stop);
    std::vector<std::string> events = dispatcher.open();
    bool told = teller.tell(events, dispatcher.finished());
    played.hear(events);
    while (told && !dispatcher.finished()) {
        played.before(dispatcher);
        events = dispatcher.tick();
        told = teller.tell(events, dispatcher.finished());
        played.hear(events);
    }
    if (!told) {
        world.brake();
        teller.refuse("the run log cannot be written");
        return 1;
    }
    played.tell_left(script.file);
    return dispatcher.reason() == "goal_reached" ? 0 : 1;
}

}  // namespace

int command_line(
    const Hierarchy& hierarchy, World& world, const std::vector<std::string>& words) {
    Options options = options_of(words);
    if (options.help) {
        std::cout << usage;
        return 0;
    }
    Terms terms;
    if (options.wrong.empty()) {
        terms.start = states_at(hierarchy, options.starts, "start", options.wrong);
        terms.goals = states_at(hierarchy, options.goals, "goal", options.wrong);
        terms.avoid = operations_at(hierarchy, options.avoids, options.wrong);
        terms.adopts = options.mismatch == "adopt";
    }
    Script script;
    if (options.wrong.empty() && !options.script.empty()) {
        script = read_script(options.script, hierarchy, options.wrong);
    }
    if (!options.wrong.empty()) {
        return wrong_usage(options.wrong);
    }
    is_number(options.seed, terms.seed);
    terms.attended = !script.acts.empty();
    terms.levels = script.levels;
    terms.refused =
        start_refused(hierarchy.blueprint, options.record, options.blueprint);
    if (options.world == "table") {
        return carried_out(hierarchy, world, terms, options, script);
    }
    const bool port = options.address.rfind("unix:", 0) != 0;
    std::string token;
    if (!options.token_file.empty()) {
        token = token_in(options.token_file, options.wrong);
    } else if (port) {
        options.wrong = options.address + " needs a token: say --token-file FILE";
    }
    if (!options.wrong.empty()) {
        return wrong_usage(options.wrong);
    }
    RemoteWorld remote(
        hierarchy, options.address, token, terms.seed, [] { return asked_to_stop != 0; });
    return carried_out(hierarchy, remote, terms, options, script);
}

}  // namespace dsfo
