// SPDX-License-Identifier: MIT
#include "core/feed/signal.h"

#include "core/filter/signal_tree.h"
#include "core/model/accounting/nominal_rate.h"
#include "core/model/accounting/probation.h"
#include "core/model/accounting/stream_counts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace posewire::feed {
namespace {

using filter::SignalNode;
using filter::SignalStep;
using filter::SignalTree;
using filter::SignalValue;

constexpr double kHalfTurn = 180;
constexpr double kDegrees = kHalfTurn / std::numbers::pi;

double normOf(const SignalValue& value, std::size_t components) {
    double squares = 0;
    for (std::size_t i = 0; i < components; ++i) {
        squares += value[i] * value[i];
    }
    return std::sqrt(squares);
}

SignalValue difference(const SignalValue& a, const SignalValue& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}

/// In degrees, of two vectors or of two orientations (w, x, y, z) of any length; NaN if one is 0.
double angleBetween(const SignalValue& a, const SignalValue& b, std::size_t components) {
    if (normOf(a, components) == 0 || normOf(b, components) == 0) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (components == 3) {
        const Eigen::Vector3d first(a[0], a[1], a[2]);
        const Eigen::Vector3d second(b[0], b[1], b[2]);
        return kDegrees * std::atan2(first.cross(second).norm(), first.dot(second));
    }
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(a[0], a[1], a[2], a[3]).conjugate() * Eigen::Quaterniond(b[0], b[1], b[2], b[3]);
    return 2 * kDegrees * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

/// A value of a node; empty if there is none in this sample.
using Result = std::optional<SignalValue>;

/// Computes the nodes of a signal, sample by sample.
class Computing {
public:
    explicit Computing(const SignalTree& tree) : m_memories(tree.memories) {}

    /// `seconds`: since the sample before; empty if its values are not those of the step before.
    std::optional<double> compute(const SignalTree& tree, std::span<const Result> sources,
                                  std::optional<double> seconds) {
        m_results.resize(tree.nodes.size());
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            const SignalNode& node = tree.nodes[i];
            m_results[i] = node.step == SignalStep::Source     ? sources[node.left]
                           : node.step == SignalStep::Constant ? Result({node.constant})
                                                               : made(node, seconds);
        }
        const Result& last = m_results.back();
        return last ? std::optional((*last)[0]) : std::nullopt;
    }

private:
    Result made(const SignalNode& node, std::optional<double> seconds) {
        using enum SignalStep;
        const Result& a = m_results[node.left];
        const std::size_t own = node.components;
        if (node.step == Speed || node.step == Derivative) {
            const Result before = std::exchange(m_memories[node.memory], a);
            return a && before && seconds ? Result(perSecond(node, *before, *a, *seconds)) : std::nullopt;
        }
        const bool isPair = node.step == Distance || node.step == Angle || node.step >= Add;
        const Result& b = m_results[isPair ? node.right : node.left];
        if (!a || !b) {
            return std::nullopt;
        }
        const bool isScale = node.step == Multiply || node.step == Divide;
        switch (node.step) {
        case Norm:
            return SignalValue{normOf(*a, own)};
        case Distance:
            return SignalValue{normOf(difference(*a, *b), own)};
        case Angle:
            return SignalValue{angleBetween(*a, *b, own)};
        default:
            break;
        }
        SignalValue value{};
        for (std::size_t i = 0; i < own; ++i) {
            const double left = (*a)[i];
            const double right = (*b)[isScale ? 0 : i];
            value[i] = node.step == Negate     ? -left
                       : node.step == Add      ? left + right
                       : node.step == Subtract ? left - right
                       : node.step == Multiply ? left * right
                                               : left / right;
        }
        return value;
    }

    static SignalValue perSecond(const SignalNode& node, const SignalValue& before, const SignalValue& now,
                                 double seconds) {
        SignalValue change = difference(now, before);
        if (node.step == SignalStep::Speed) {
            const bool isTurn = node.components == change.size();
            return {(isTurn ? angleBetween(before, now, node.components) : normOf(change, node.components)) /
                    seconds};
        }
        for (double& one : change) {
            one = (node.isAngle ? std::remainder(one, 2 * kHalfTurn) : one) / seconds;
        }
        return change;
    }

    std::vector<Result> m_memories; ///< operands of the nodes that remember them, in the sample before
    std::vector<Result> m_results;  ///< of the nodes
};

/// The samples of a character as they come, in any order and in any number of packets.
class Track {
public:
    Track(log::SenderId sender, std::uint8_t character, const SignalTree& tree)
        : m_sender(sender),
          m_character(character),
          m_lasts(tree.sources.size()),
          m_from(tree.sources.size()),
          m_keepsTime(tree.memories != 0),
          m_computing(tree) {
        for (Sample& sample : m_samples) {
            sample.values.resize(tree.sources.size());
        }
    }

    [[nodiscard]] bool isOf(log::SenderId sender, std::uint8_t character) const {
        return m_sender == sender && m_character == character;
    }

    /// The signal's value if the packet is the last that its sample lacked for it.
    std::optional<double> take(const SignalTree& tree, field::Subject& packet, const wire::Header& header) {
        const model::PacketDigest& digest = packet.candidate.digest;
        Sample& sample = sampleOf(header);
        sample.followsGap = sample.followsGap || digest.gap != 0 || digest.isRestart || digest.isInDoubt;
        if (sample.isDone) {
            return std::nullopt;
        }
        bool isWhole = true;
        for (std::size_t i = 0; i < tree.sources.size(); ++i) {
            Result& value = sample.values[i];
            if (!value && isReadFrom(tree, i, header)) {
                value = tree.sources[i].read(packet, m_lasts[i]);
                m_from[i] = value ? From{header.type(), header.sampleCounter} : m_from[i];
            }
            isWhole = isWhole && value;
        }
        sample.isDone = isWhole;
        return isWhole ? computed(tree, sample) : std::nullopt;
    }

private:
    struct Mark {
        std::uint32_t counter = 0;
        std::uint32_t timeCode = 0;
    };
    struct Sample : Mark {
        bool isUsed = false;
        bool isDone = false; ///< it had its value
        bool followsGap = false;
        std::vector<Result> values; ///< of the sources
    };
    static constexpr std::size_t kSamples = 16; ///< that may be on the way at once
    struct From {
        std::uint8_t type = 0; ///< 0: none yet
        std::uint32_t sample = 0;
    };

    /// How far a sample is ahead of another.
    static std::int32_t ahead(std::uint32_t sample, std::uint32_t of) {
        return static_cast<std::int32_t>(sample - of);
    }

    /// Several types may have the same: one of them is read as long as it goes on.
    [[nodiscard]] bool isReadFrom(const SignalTree& tree, std::size_t source,
                                  const wire::Header& header) const {
        constexpr std::int32_t kGone = 240;
        const From& from = m_from[source];
        return tree.types.size() < 2 || from.type == 0 || from.type == header.type() ||
               std::abs(ahead(header.sampleCounter, from.sample)) > kGone;
    }

    Sample& sampleOf(const wire::Header& header) {
        const std::uint32_t counter = header.sampleCounter;
        if (m_samples[m_newest].isUsed && ahead(counter, m_highest) < -model::Probation::kMostBack) {
            std::ranges::for_each(m_samples, [](Sample& sample) { sample.isUsed = false; });
            m_before.reset();
        }
        if (!m_samples[m_newest].isUsed || ahead(counter, m_highest) > 0) {
            m_highest = counter;
            if (m_keepsTime) {
                m_rate.add(counter, header.timeCode);
                m_hz = m_rate.frameHz() ? m_rate.frameHz() : m_hz;
            }
        }
        for (std::size_t i = 0; i < kSamples; ++i) {
            Sample& sample = m_samples[(m_newest + kSamples - i) % kSamples];
            if (sample.isUsed && sample.counter == counter) {
                // Types 10 to 13 all have the same.
                return sample.isDone && !model::countsSamples(header.type()) ? begun(sample, header) : sample;
            }
        }
        m_newest = (m_newest + 1) % kSamples;
        return begun(m_samples[m_newest], header);
    }

    static Sample& begun(Sample& sample, const wire::Header& header) {
        std::ranges::fill(sample.values, std::nullopt);
        sample.counter = header.sampleCounter;
        sample.isUsed = true;
        sample.isDone = sample.followsGap = false;
        sample.timeCode = header.timeCode;
        return sample;
    }

    std::optional<double> computed(const SignalTree& tree, const Sample& sample) {
        if (tree.memories == 0) {
            return m_computing.compute(tree, sample.values, std::nullopt);
        }
        if (m_before && ahead(sample.counter, m_before->counter) <= 0) { // late: what came after it is known
            return std::nullopt;
        }
        const auto isMissing = [&](const Sample& other) {
            return other.isUsed && !other.isDone && ahead(other.counter, m_before->counter) > 0 &&
                   ahead(sample.counter, other.counter) > 0;
        };
        const bool follows = m_before && !sample.followsGap && std::ranges::none_of(m_samples, isMissing);
        const auto seconds = follows ? secondsBetween(*m_before, sample) : std::nullopt;
        m_before = sample;
        return m_computing.compute(tree, sample.values, seconds);
    }

    /// By the sender's own clock, whose whole milliseconds are taken for the time only before its rate is
    /// known.
    [[nodiscard]] std::optional<double> secondsBetween(const Mark& before, const Mark& sample) const {
        const double seconds = m_hz ? ahead(sample.counter, before.counter) / *m_hz
                                    : model::timeCodeStep(before.timeCode, sample.timeCode) / 1000.0;
        return seconds > 0 ? std::optional(seconds) : std::nullopt;
    }

    log::SenderId m_sender;
    std::uint8_t m_character;
    std::vector<std::size_t> m_lasts; ///< of the sources: where their items were
    std::vector<From> m_from;
    bool m_keepsTime; ///< it has derivatives
    std::array<Sample, kSamples> m_samples{};
    std::size_t m_newest = 0;
    std::uint32_t m_highest = 0;
    model::NominalRate m_rate;
    std::optional<double> m_hz;   ///< as it was last known
    std::optional<Mark> m_before; ///< the sample whose values are remembered
    Computing m_computing;
};

/// A signal as it reads: the characters are told apart here, so that packets of several may come.
class Reading {
public:
    explicit Reading(std::shared_ptr<const SignalTree> tree) : m_tree(std::move(tree)), m_computing(*m_tree) {
        for (const std::uint8_t type : m_tree->types) {
            m_isRead[type] = true;
        }
    }

    std::optional<double> operator()(field::Subject& packet) {
        const field::Candidate& candidate = packet.candidate;
        const wire::Header* header = packet.header();
        const bool isSample = !m_tree->types.empty();
        const bool isRead =
            !isSample || (candidate.datagram != nullptr && header != nullptr && m_isRead[header->type()]);
        if (!isRead || !m_tree->where.matches(candidate)) {
            return std::nullopt;
        }
        return isSample ? trackOf(candidate.packet.sender, header->character).take(*m_tree, packet, *header)
                        : alone(packet);
    }

private:
    /// Computes a signal of fields that all packets have.
    std::optional<double> alone(field::Subject& packet) {
        std::size_t last = 0;
        m_values.clear();
        for (const filter::SignalSource& source : m_tree->sources) {
            m_values.push_back(source.read(packet, last));
        }
        return m_computing.compute(*m_tree, m_values, std::nullopt);
    }

    Track& trackOf(log::SenderId sender, std::uint8_t character) {
        constexpr std::size_t kMost = 4096;
        const auto isIt = [&](const Track& track) { return track.isOf(sender, character); };
        if (m_newest < m_tracks.size() && isIt(m_tracks[m_newest])) {
            return m_tracks[m_newest];
        }
        const auto found = std::ranges::find_if(m_tracks, isIt);
        m_newest = static_cast<std::size_t>(found - m_tracks.begin());
        if (found == m_tracks.end()) {
            if (m_tracks.size() == kMost) {
                m_tracks.clear();
            }
            m_newest = m_tracks.size();
            m_tracks.emplace_back(sender, character, *m_tree);
        }
        return m_tracks[m_newest];
    }

    std::shared_ptr<const SignalTree> m_tree;
    std::array<bool, 256> m_isRead{};
    std::vector<Track> m_tracks;
    std::size_t m_newest = 0;
    std::vector<Result> m_values;
    Computing m_computing;
};

} // namespace

tl::expected<Expression, filter::FilterError> parseSignal(std::string_view text) {
    auto tree = filter::parsedSignal(text);
    if (!tree) {
        return tl::unexpected(tree.error());
    }
    const auto shared = std::make_shared<const SignalTree>(*std::move(tree));
    return Expression{shared->text, shared->quantity.dimension, shared->quantity.unit, shared->types,
                      Reading(shared)};
}

} // namespace posewire::feed
