#include "player.hpp"

#include <algorithm>

namespace dsfo {

namespace {

constexpr double hair = 1e-9;

// Whether nothing moves before the next command.
bool waits(const std::string& phase) {
    return phase == "ready" || phase == "paused" || phase == "waiting" || phase == "no_route" ||
           phase == "taken_over" || phase == "fault_hold" || phase == "stopped";
}

bool fits(const Act& act, const std::string& kind, const std::string& about) {
    const auto same = [&act](const std::string& name, const std::string& value) {
        return !act.command.said.count(name) || act.command.text(name) == value;
    };
    return same("kind", kind) && same("address", about);
}

bool is_same(const Due& one, const Due& other) {
    return one.act == other.act && one.task == other.task && one.turn == other.turn &&
           one.time >= other.time && one.time <= other.time;
}

void give(Dispatcher& dispatcher, const Act& act) {
    Command command = act.command;
    if (command.word == "by_hand" || command.word == "automatic") {
        command.said = {{"automatic", json_of_flag(command.word == "automatic")}};
        command.word = "set_automatic";
    }
    if (command.word == "ask") {
        command.said["every_time"] = json_of_flag(act.times == 0 && act.moment != Moment::at);
    }
    dispatcher.command(command);
}

std::string text_of(const Json& event, const std::string& name) {
    std::string found;
    event.text_of(name, found);
    return found;
}

}  // namespace

// moments -------------------------------------------------------------------------------------------

void Moments::met(const Json& event, std::vector<Due>& due) {
    const std::string word = text_of(event, "event");
    double time = 0.0;
    event.number_of("t", time);
    if (word == "run_started") {
        arrived(*event.find("start"), time, due);
    } else if (word == "committed") {
        for (const Json& edge : event.list_of("operations")) {
            going_.erase(edge.text);
        }
        arrived(*event.find("configuration"), time, due);
    } else if (word == "relocalised") {
        going_.clear();
        Json moved;
        const Json& here = *event.find("configuration");
        for (std::size_t at = 0; at < here.names.size(); ++at) {
            if (configuration_[here.names[at]] != here.items[at].text) {
                moved.names.push_back(here.names[at]);
                moved.items.push_back(here.items[at]);
            }
        }
        arrived(moved, time, due);
    } else if (word == "operation_started") {
        going_.insert(text_of(event, "address"));
        named(Moment::during, text_of(event, "address"), time, due);
    } else if (word == "operation_ended") {
        going_.erase(text_of(event, "address"));
    } else if (word == "held" || word == "mismatch" || word == "stopped" || word == "taken_over") {
        going_.clear();
    } else if (word == "task_opened") {
        open_.insert(text_of(event, "task"));
        asked(event, time, due);
    } else if (word == "task_closed") {
        open_.erase(text_of(event, "task"));
    }
}

bool Moments::is_over(const Due& due) const {
    if (due.act->moment == Moment::during) {
        return going_.count(due.act->address) == 0;
    }
    return !due.task.empty() && open_.count(due.task) == 0;
}

void Moments::arrived(const Json& states, double time, std::vector<Due>& due) {
    for (std::size_t at = 0; at < states.names.size(); ++at) {
        configuration_[states.names[at]] = states.items[at].text;
    }
    for (std::size_t at = 0; at < states.names.size(); ++at) {
        named(Moment::when, address({states.names[at], states.items[at].text}), time, due);
    }
}

void Moments::named(
    Moment moment, const std::string& at, double time, std::vector<Due>& due) {
    const long count = ++counts_[{moment, at}];
    for (const Act& act : acts_) {
        if (act.moment == moment && act.address == at && (act.times == 0 || act.times == count)) {
            due.push_back(Due{time + act.seconds, &act, "", act.turn});
        }
    }
}

void Moments::asked(const Json& event, double time, std::vector<Due>& due) {
    for (const Act& act : acts_) {
        if (act.moment == Moment::asked &&
            fits(act, text_of(event, "kind"), text_of(event, "address"))) {
            const long count = ++asked_[act.line];
            if (act.times == 0 || act.times == count) {
                due.push_back(Due{time + act.seconds, &act, text_of(event, "task"), act.turn});
            }
        }
    }
}

// the player ----------------------------------------------------------------------------------------

Player::Player(const Script& script) : script_(script), moments_(script.acts) {
    for (const Act& act : script.acts) {
        left_.insert(act.line);
        if (act.moment == Moment::at) {
            due_.push_back(Due{act.seconds, &act, "", act.turn});
        }
    }
}

std::vector<const Act*> Player::left() const {
    std::vector<const Act*> found;
    for (const Act& act : script_.acts) {
        if (left_.count(act.line)) {
            found.push_back(&act);
        }
    }
    return found;
}

void Player::hear(const std::vector<std::string>& events) {
    for (const std::string& event : events) {
        Json read;
        if (read_json(event, read)) {
            moments_.met(read, due_);
            due_.erase(
                std::remove_if(
                    due_.begin(), due_.end(),
                    [this](const Due& due) { return moments_.is_over(due); }),
                due_.end());
        }
    }
}

void Player::before(Dispatcher& dispatcher) {
    const std::vector<Due> now = come(dispatcher);
    const std::vector<Due> acts = ready(dispatcher, now);
    for (const Due& due : now) {
        const auto known = std::find_if(
            due_.begin(), due_.end(), [&due](const Due& one) { return is_same(one, due); });
        if (due.turn > 1 && known != due_.end()) {
            --known->turn;
        }
    }
    if (asking_ != nullptr) {
        give(dispatcher, *asking_);
        asking_ = nullptr;
        return;
    }
    if (std::any_of(acts.begin(), acts.end(), [](const Due& due) {
            return due.act->command.word == "pause";
        })) {
        resuming_.clear();
    }
    if (!resuming_.empty() && acts.empty() && dispatcher.phase() != "running") {
        Command resume;
        resume.word = "resume";
        std::swap(resume.by, resuming_);
        resuming_.clear();
        if (dispatcher.phase() == "paused") {
            dispatcher.command(resume);
            return;
        }
    }
    for (const Due& due : acts) {
        forget(due);
        carry_out(due, dispatcher);
    }
    if (acts.empty() && due_.empty() && waits(dispatcher.phase())) {
        dispatcher.leave();
    }
}

std::vector<Due> Player::come(const Dispatcher& dispatcher) const {
    std::vector<Due> found;
    const double now = dispatcher.time() + hair;
    std::copy_if(
        due_.begin(), due_.end(), std::back_inserter(found),
        [now](const Due& due) { return due.time <= now; });
    return found;
}

// In a paused run time stands still, so the next act by time is due at once.
std::vector<Due> Player::ready(
    const Dispatcher& dispatcher, const std::vector<Due>& now) const {
    std::vector<Due> found;
    if (now.empty() && dispatcher.phase() == "paused" && resuming_.empty()) {
        double soonest = 0.0;
        for (std::size_t at = 0; at < due_.size(); ++at) {
            soonest = at == 0 ? due_[at].time : std::min(soonest, due_[at].time);
        }
        std::copy_if(
            due_.begin(), due_.end(), std::back_inserter(found),
            [soonest](const Due& due) { return due.time <= soonest; });
    } else {
        std::copy_if(
            now.begin(), now.end(), std::back_inserter(found),
            [](const Due& due) { return due.turn <= 1; });
    }
    std::stable_sort(found.begin(), found.end(), [](const Due& one, const Due& other) {
        return std::make_pair(one.time, one.act->line) <
               std::make_pair(other.time, other.act->line);
    });
    return found;
}

void Player::forget(const Due& due) {
    const auto known = std::find_if(
        due_.begin(), due_.end(), [&due](const Due& one) { return is_same(one, due); });
    if (known != due_.end()) {
        due_.erase(known);
    }
}

void Player::carry_out(const Due& due, Dispatcher& dispatcher) {
    const Act& act = *due.act;
    const std::string& word = act.command.word;
    if (word == "answer") {
        std::string task = due.task;
        for (const Task* open : dispatcher.tasks()) {
            if (task.empty() && fits(act, open->question.kind, open->question.address)) {
                task = open->name;
            }
        }
        if (task.empty()) {
            return;
        }
        dispatcher.answer(
            task, act.command.text("option"), act.command.by, act.command.text("role"));
    } else if (
        word == "ask" && !by_hand_ && dispatcher.phase() == "running" && !dispatcher.carrying()) {
        // the run would choose the next operation itself, so it is paused one tick before
        Command pause;
        pause.word = "pause";
        pause.by = act.command.by;
        dispatcher.command(pause);
        asking_ = &act;
        resuming_ = act.command.by;
    } else {
        by_hand_ = word == "by_hand" || (by_hand_ && word != "automatic");
        give(dispatcher, act);
    }
    left_.erase(act.line);
}

}  // namespace dsfo
