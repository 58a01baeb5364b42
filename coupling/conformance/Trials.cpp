// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/Trials.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace gimdem::conformance
{
namespace
{

using coupling::Schedule;

/// A client with a longer time-out is not waited for.
double constexpr longest_timeout = 10;  ///< [s]

std::string code_text(TrialResult const& result)
{
    if (!result.exit_code) return "it hung";
    if (*result.exit_code == 127) return "it could not be started, or ended with exit code 127";
    if (*result.exit_code > 128) return "it was killed by signal " + std::to_string(*result.exit_code - 128);
    return "exit code " + std::to_string(*result.exit_code);
}

std::string seconds_text(double seconds)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.2g s", seconds);
    return text;
}

class Trials
{
public:
    Trials(TrialOptions const& options, Script const& script, std::function<void(Finding const&)> const& tell)
        : options_(options), script_(script), tell_(tell)
    {
    }

    void run()
    {
        using Trial = std::pair<char const*, std::function<void(std::string const&)>>;
        Trial const all[] = {
            {"serial", [this](auto const& name) { whole_run(name, Schedule::serial); }},
            {"overlapped", [this](auto const& name) { whole_run(name, Schedule::overlapped); }},
            {"iterated",
             [this](auto const& name)
             {
                 if (iterates_) whole_run(name, Schedule::iterated);
             }},
            {"stop request", [this](auto const& name) { stop_request(name); }},
            {"wrong version", [this](auto const& name) { refusal(name, Misbehaviour::wrong_version); }},
            {"refused mesh", [this](auto const& name) { refusal(name, Misbehaviour::refuse_mesh); }},
            {"truncated field", [this](auto const& name) { refusal(name, Misbehaviour::truncate); }},
            {"error of server", [this](auto const& name) { refusal(name, Misbehaviour::report_error); }},
            {"lost server", [this](auto const& name) { refusal(name, Misbehaviour::die); }},
            {"slow server", [this](auto const& name) { slow_server(name); }},
            {"silent server", [this](auto const& name) { silent_server(name); }}};
        for (auto const& [name, trial] : all)
            if (options_.only.empty() || options_.only == name) trial(name);
    }

private:
    Script script(Misbehaviour misbehaviour) const
    {
        Script result = script_;
        result.misbehaviour = misbehaviour;
        if (misbehaviour != Misbehaviour::none) result.end_time = 1e6;  // it does not end by itself
        return result;
    }

    TrialResult try_out(Script const& script, double extra = 0)
    {
        TrialResult result = run_trial(options_, script, std::to_string(++count_), extra);
        if (result.timeout) timeout_ = result.timeout;
        return result;
    }

    void tell(std::string const& name, bool passed, std::string const& text) const
    {
        tell_({name, passed ? Verdict::passed : Verdict::failed, text});
    }

    /// A session without misbehaviour, to the end time.
    void whole_run(std::string const& name, Schedule schedule)
    {
        Script plain = script(Misbehaviour::none);
        plain.schedule = schedule;
        TrialResult const result = try_out(plain);
        iterates_ = result.iterates;
        if (!result.insists_on.empty() && result.insists_on != name)
            return tell_(
                {name, Verdict::skipped, "not tried: the client insists on the schedule " + result.insists_on});
        for (Finding finding : result.findings)
        {
            bool const once = finding.name == "handshake" || finding.name == "mesh";
            if (schedule != Schedule::serial && once && finding.verdict == Verdict::passed) continue;
            finding.name = name + ": " + finding.name;
            tell_(finding);
        }
        bool const good = result.exit_code == 0;
        tell(name + ": exit code", good,
             good ? "0" : code_text(result) + "; its last words: " + last_line(result.output));
    }

    void stop_request(std::string const& name)
    {
        TrialResult const result = try_out(script(Misbehaviour::request_stop), options_.limit);
        std::string text = code_text(result);
        bool good = result.exit_code == 0;
        bool was_asked = false;
        for (Finding const& finding : result.findings)
        {
            if (finding.name == "stop request") was_asked = true;
            if (finding.name != "stop request" && finding.verdict != Verdict::failed) continue;
            good = good && finding.verdict == Verdict::passed;
            text += "; " + finding.text;
        }
        tell(name, good && was_asked, text);
    }

    /// The client has to end by itself, in time, with an exit code that is not 0.
    void refusal(std::string const& name, Misbehaviour misbehaviour)
    {
        judge_refusal(name, try_out(script(misbehaviour)));
    }

    void judge_refusal(std::string const& name, TrialResult const& result) const
    {
        bool const good = result.exit_code && *result.exit_code > 0 && *result.exit_code < 127;
        std::string text = code_text(result) + " after " + seconds_text(result.late);
        text += good ? ": " + last_line(result.output) : " (it has to end by itself, with a code that is not 0)";
        auto const fault = std::find_if(result.findings.begin(), result.findings.end(),
                                        [](Finding const& finding) { return finding.verdict == Verdict::failed; });
        if (fault != result.findings.end()) text = fault->text + "; " + text;
        tell(name, good && fault == result.findings.end(), text);
    }

    bool knows_short_timeout(std::string const& name)
    {
        if (!timeout_) try_out(script(Misbehaviour::wrong_version));  // its Hello tells
        if (timeout_ && *timeout_ <= longest_timeout) return true;
        tell_({name, Verdict::skipped,
               "not tried: give the client a time-out of " + seconds_text(longest_timeout) + " or less" +
                   (timeout_ ? " (it has " + seconds_text(*timeout_) + ")" : "")});
        return false;
    }

    /// An answer that takes longer than the time-outs of both sides is no fault: heartbeats go on.
    void slow_server(std::string const& name)
    {
        if (!knows_short_timeout(name)) return;
        Script late = script_;
        late.misbehaviour = Misbehaviour::delay;
        late.timeout = 2;
        late.delay = 1.3 * std::max(*timeout_, late.timeout);
        TrialResult const result = try_out(late, late.delay + options_.limit);
        bool good = result.exit_code == 0;
        std::string text = "answer after " + seconds_text(late.delay) + ", " + code_text(result);
        for (Finding const& finding : result.findings)
            if (finding.verdict == Verdict::failed)
            {
                good = false;
                text += "; " + finding.text;
            }
        tell(name, good, good ? text : text + "; its last words: " + last_line(result.output));
    }

    void silent_server(std::string const& name)
    {
        if (!knows_short_timeout(name)) return;
        judge_refusal(name, try_out(script(Misbehaviour::fall_silent), *timeout_));
    }

    TrialOptions const& options_;
    Script const& script_;
    std::function<void(Finding const&)> const& tell_;
    std::optional<double> timeout_;  ///< of the client, once it is known [s]
    bool iterates_ = true;           ///< the client repeats steps, as far as is known
    int count_ = 0;
};

}  // namespace

void try_client(TrialOptions const& options, Script const& script, std::function<void(Finding const&)> const& tell)
{
    Trials(options, script, tell).run();
}

}  // namespace gimdem::conformance
