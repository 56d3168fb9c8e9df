// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/ingest.h"
#include "core/model/session/session_view.h"
#include "core/model/session/verdict.h"

#include <array>
#include <optional>

namespace posewire::model {

/// A session without its view.
class SessionState {
protected:
    explicit SessionState(const log::PacketLog& log) : m_ingest(log) {}

    Ingest m_ingest;
    Choices m_choices;
};

/// A session is three things: what ingests a log (Ingest), what the operator chose (Choices), and the view of
/// the one as the other asks for (SessionView). Who may change it has this class; all others have the view.
class Session final : private SessionState, public SessionView {
public:
    explicit Session(const log::PacketLog& log) : SessionState(log), SessionView(m_ingest, m_choices) {}

    /// Reads at most `most` new packets; true if there were any. `now` (wall clock) is what ages are
    /// measured against.
    bool follow(log::Stamp now, std::size_t most = 200'000) { return m_ingest.follow(now, most); }
    /// Whether time that passes is no evidence: what came meanwhile is not in the log yet (see HeldUp).
    void setHeldUp(bool isHeldUp) { m_ingest.setHeldUp(isHeldUp); }
    /// The same while a file is read: however new its packets are, silence after them is no silence.
    bool followFile(log::Stamp now, std::size_t most = 200'000) { return m_ingest.followFile(now, most); }
    /// See Roll.
    void setEdges(const TimeRange& range) { m_ingest.setEdges(range); }
    /// Makes counts of the chosen range exact to the packet: reads again what came around its ends, unless
    /// that would take long. To be called repeatedly; waits until the range has been the same for two calls.
    void sharpenRange();
    /// Nothing more is read: what is not there by now is lost.
    void settle() { m_ingest.settle(); }
    /// All that was read is a file that has ended: its end is no outage, however long it was recorded after
    /// its last packet.
    void endFile() { m_ingest.endFile(); }

    /// What the kernel counted since this computer began to listen.
    void setKernel(const log::KernelCounters& counters) { m_ingest.setKernel(counters); }

    /// What verdicts() says is judged now and stays until this is called again, so that all that show it say
    /// the same. Without this it is judged whenever something has changed.
    void judge() { verdicts().keep(); }

    /// Holds for what comes from now on.
    void setThresholds(const Thresholds& thresholds) { m_ingest.incidents().setThresholds(thresholds); }
    /// Something that no packet tells: it happened in this computer.
    void report(IncidentKind kind, log::Stamp now, words::Fact detail, log::SenderId sender = log::kNoSender);
    /// What the operator declares about a sender counts instead of what was detected, also for the senders
    /// that follow it on the same host. Nothing happens where there is no such sender.
    void setOverride(log::SenderId sender, const SenderOverride& overrides) {
        m_ingest.setOverride(sender, overrides);
    }

    /// The same about all senders that come from now on.
    void setUsual(const SenderOverride& usual) { m_ingest.setUsual(usual); }

    void setCursor(Cursor cursor) { m_choices.cursor = cursor; }
    void setSelection(const Selection& selection) { m_choices.selection = selection; }
    void setRange(const RangeChoice& range) { m_choices.range = range; }
    /// The filter is not checked here.
    void setDisplayFilter(std::string filter) { m_choices.displayFilter = std::move(filter); }
    /// See Choices.
    void jump(const Selection& selection, std::string filter) {
        m_choices.jump(selection, std::move(filter));
    }
    void leave() { m_choices.leave(); }
    bool goBack() { return m_choices.goBack(); }
    bool goForward() { return m_choices.goForward(); }
    void setMarked(std::uint64_t packet, bool isMarked) {
        setIn(m_choices.annotations.marks, packet, isMarked);
    }
    /// An empty comment takes the comment away.
    void setComment(std::uint64_t packet, std::string comment) {
        if (comment.empty()) {
            m_choices.annotations.comments.erase(packet);
        } else {
            m_choices.annotations.comments[packet] = std::move(comment);
        }
    }
    /// Through restarts of its sender.
    void setHidden(const CharacterKey& key, bool isHidden) { choose(m_choices.hidden, key, isHidden); }
    /// Puts a character on the floor that is sent below it, through restarts of its sender.
    void setLifted(const CharacterKey& key, bool isLifted) { choose(m_choices.lifted, key, isLifted); }
    /// Takes a sender out of all lists that has ended, or has been silent for a second: its sums stay, and
    /// what its characters were goes to those that took over. False, and nothing happens, where it sends.
    bool forget(log::SenderId sender);
    /// From now on a new span counts; what was received stays.
    void resetForTake() {
        m_choices.reset = now();
        m_choices.range = {.isSinceReset = true};
    }
    void askForIncident(std::optional<std::uint64_t> number, std::optional<CharacterKey> of) {
        m_choices.askForIncident(number, of);
    }
    void setGhostShown(bool isShown) { m_choices.isGhostShown = isShown; }

private:
    std::optional<TimeRange> m_edges; ///< of the range that is chosen, as it was
    std::array<bool, 2> m_isExact{};  ///< from its beginning on, up to its end

    void choose(std::set<CharacterKey>& chosen, const CharacterKey& key, bool isIn) {
        for (const Character* one : roster().lineage(atNow().roster().current(key))) {
            setIn(chosen, one->key, false);
        }
        setIn(chosen, key, isIn);
    }
    template <class Value>
    static void setIn(std::set<Value>& set, const Value& value, bool isIn) {
        if (isIn) {
            set.insert(value);
        } else {
            set.erase(value);
        }
    }
};

} // namespace posewire::model
