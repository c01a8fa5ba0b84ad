// The dispatcher's end of a connection to a world that is a program elsewhere. A frame is a length of
// four bytes and a JSON object. There is one question at a time; only `stop` does not wait.
#pragma once

#include <functional>
#include <string>

#include "json_reader.hpp"

namespace dsfo {

using Hurry = std::function<bool()>;  // whether a person wants to stop

class Wire {
public:
    explicit Wire(Hurry hurry) : hurry_(std::move(hurry)) {}
    ~Wire();
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;

    // Both return why it is not possible, empty if it is. `members` are JSON members, perhaps none.
    std::string connect(const std::string& address);
    std::string ask(
        const std::string& verb, const std::string& members, double limit, Json& answer);

    // Send a stop at once, even while an answer is owed. Whether it was acknowledged in time.
    bool stop();
    void close();

    bool interrupted() const { return interrupted_; }  // a stop came before the answer
    bool declined() const { return declined_; }  // the world has refused the question
    void name_session(const std::string& session) { session_ = session; }

private:
    enum class Came { frame, nothing, lost };

    std::string send(const std::string& verb, const std::string& members, long long until);
    Came receive(long long until, Json& frame, std::string& why);
    bool wait(short event, long long until) const;

    Hurry hurry_;
    int end_ = -1;
    long number_ = 0;
    std::string session_;
    std::string bytes_;  // that have come and are no whole frame yet
    bool interrupted_ = false;
    bool declined_ = false;
};

}  // namespace dsfo
