// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/loss_evidence.h"
#include "core/model/accounting/stream_counts.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace posewire::model {

/// Samples of a stream that are not there yet, and not yet lost.
struct PendingLoss {
    log::StreamKey stream;
    std::uint64_t samples = 0;
    log::Stamp from{};
    log::Stamp to{};
    bool isUnderWay = false; ///< the rest of the newest sample, after which nothing came: it may just come
};

/// Samples of a stream that are lost for good, as far as is known, or of which only a part came.
struct Loss {
    log::StreamKey stream;
    LossCause cause = LossCause::Unknown;
    std::uint64_t samples = 0;
    log::Stamp from{};
    log::Stamp to{};
    std::uint64_t fromPacket = 0;
    std::uint64_t toPacket = 0;
    std::uint64_t incident = 0; ///< that some of it was told in; 0 for none
    words::Fact evidence;
};

/// Told of every loss, and of what was not lost after all: the sums of what it is told are
/// Stream::attributed.
class LossSink {
public:
    /// Returns the number of the incident that it belongs to.
    virtual std::uint64_t takeLoss(const Loss& loss) = 0;
    /// Samples of that incident came after all; `isAll`: the whole gap is filled.
    virtual void takeBack(std::uint64_t incident, const log::StreamKey& stream, std::uint64_t samples,
                          bool isAll) = 0;

protected:
    ~LossSink() = default;
};

/// Finds whose loss each gap and each incomplete sample was, from the log alone: the answer is the same in
/// whatever portions it is read. Judged some time of the log later, since late arrivals may still fill it,
/// and corrected where they come even later.
class Attribution {
public:
    /// At least; longer after samples that came later.
    static constexpr log::Duration kPatience = std::chrono::milliseconds(150);
    static constexpr std::size_t kMostGaps = 65'536;
    static constexpr std::size_t kMostBytes = std::size_t{32} << 20;

    /// The sink outlives this.
    explicit Attribution(LossSink& sink) : m_sink(&sink) {}

    /// Others add to it what they see.
    [[nodiscard]] LossEvidence& evidence() { return m_evidence; }
    /// What is yet to be judged of the sender's streams stays as it is.
    void retire(log::SenderId sender);

    /// Each packet, before its content: notes drops and judges what is due.
    void takePacket(const log::Packet& packet, const log::SenderInfo& from);
    /// Nothing more comes: judges all.
    void settle() { judgeDue({}, m_lastPacket + 1, true); }
    /// Time passes without packets: judges what is due.
    void advance(log::Stamp stamp) { judgeDue(stamp, m_lastPacket + 1); }
    /// What waits of the stream is judged before its accounting forgets it.
    static void expectJudgement(Stream& stream);
    /// A verdict of the stream's accounting.
    void takeVerdict(Stream& stream, const Verdict& verdict);

    /// Calls f(const PendingLoss&) for gaps and for samples of which a part is missing.
    template <class Function>
    void forEachPending(Function&& f) const {
        forEachWaiting([&](const Gap& gap) {
            if (gap.lost != 0) {
                f(PendingLoss{gap.stream, gap.lost, gap.fromStamp, gap.toStamp});
            }
        });
        for (const Partial& partial : m_partials) {
            if (partial.stream != nullptr && partial.stream->accounting.isIncomplete(partial.sample)) {
                f(PendingLoss{partial.stream->key, 1, partial.stamp, partial.stamp, partial.nextPacket == 0});
            }
        }
    }
    [[nodiscard]] log::Duration patience() const { return m_patience; }
    /// The newest ones, oldest first.
    [[nodiscard]] const std::deque<Gap>& gaps() const { return m_gaps; }
    /// Calls f(stream, stamp, cause, packet) for the newest samples and messages of which only a part came,
    /// oldest first, with when they should have come, whose loss the rest was and the first packet of them.
    template <class Function>
    void forEachPartialLoss(Function&& f) const {
        for (const Partial& partial : m_judgedPartials) {
            f(partial.stream->key, partial.stamp, partial.cause, partial.packet);
        }
    }
    [[nodiscard]] std::size_t memoryBytes() const;
    /// The gap that a packet ended; null if it ended none, or one that is forgotten.
    [[nodiscard]] const Gap* endedBy(std::uint64_t packet) const;

    /// The first packet that ended a gap after a moment and is yet to be judged; UINT64_MAX for none.
    [[nodiscard]] std::uint64_t firstPending(log::Stamp after) const;

    struct Recount {
        std::uint64_t packet = 0; ///< that ended the gap
        std::uint32_t lost = 0;
    };
    /// Those since they were cleared, in the order in which they were counted.
    [[nodiscard]] const std::vector<Recount>& recounts() const { return m_recounts; }
    void clearRecounts() { m_recounts.clear(); }

private:
    /// A sample, or a message of types 10 to 13, of which only a part has come yet.
    struct Partial {
        Stream* stream = nullptr; ///< null if it was judged, or retired
        std::uint32_t sample = 0; ///< 0 of a message
        log::Stamp stamp{};
        std::uint64_t packet = 0;     ///< the first that came of it
        std::uint64_t nextPacket = 0; ///< the first of the next sample of the stream; 0 until that comes
        LossCause cause = LossCause::Unknown;
        std::uint64_t incident = 0;
    };
    /// Something that is judged when its time has come.
    struct Due {
        enum class What : std::uint8_t { Gap, Partial, Rest };
        What what = What::Gap;
        Stream* stream = nullptr; ///< null if it was judged, or retired
        log::Stamp at{};
        std::uint64_t number = 0;    ///< of the gap or partial
        std::uint64_t datagrams = 0; ///< of the stream until then
    };

    /// Calls f(const Gap&) for the gaps that are yet to be judged.
    template <class Function>
    void forEachWaiting(Function&& f) const {
        for (const Due& due : m_due) {
            if (due.what == Due::What::Gap && due.stream != nullptr) {
                f(m_gaps[due.number - m_firstGap]);
            }
        }
    }
    void expect(const Due& due);
    void expectPartial(Stream& stream, const Verdict& verdict, log::Duration patience);
    void forgetGap();
    void judgeEarly(Stream& stream, std::uint64_t packet);
    void judgeDue(log::Stamp stamp, std::uint64_t packet, bool isAll = false);
    void judge(Due& due, std::uint64_t packet);
    void judge(Partial& partial, std::uint64_t packet);
    /// The rest of a sample or message is lost, by the packets up to `lastPacket`.
    void lose(const Partial& partial, std::uint64_t lastPacket, std::uint64_t toPacket, words::Fact evidence);
    void attributeRest(Stream& stream);
    void takePartial(Stream& stream, const Verdict& verdict);
    void recount(Gap& gap, Stream& stream, std::optional<std::uint32_t> late);
    const Gap* recount(Stream& stream, std::optional<std::uint32_t> around);

    LossSink* m_sink;
    log::Duration m_patience = kPatience;
    std::optional<log::Stamp> m_lateSeen; ///< the last sample that came later than it was waited for
    std::uint64_t m_lastPacket = 0;
    LossEvidence m_evidence;
    std::deque<Due> m_due; ///< by when they are judged, the next one first
    std::deque<Gap> m_gaps;
    std::uint64_t m_firstGap = 0;
    std::deque<Partial> m_partials; ///< from the oldest on that is yet to be judged
    std::uint64_t m_firstPartial = 0;
    std::deque<Partial> m_judgedPartials; ///< the newest ones
    std::vector<Recount> m_recounts;
};

} // namespace posewire::model
