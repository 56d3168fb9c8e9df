// SPDX-License-Identifier: MIT
#include "core/model/session/roster.h"
#include "core/performer/noise.h"
#include "tests/core/model/session/session_fixture.h"

#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

/// Whose loss each missing sample was, of stages where everything goes wrong at random and in seams, against
/// what the sender, the network and this computer know of it.
namespace posewire::model {
namespace {

constexpr int kSeeds = 100;
constexpr std::array<const char*, 4> kHosts{"10.0.0.1:50001", "10.0.0.2:50001", "10.0.0.3:50001",
                                            "10.0.0.4:50001"};
constexpr std::array<std::uint8_t, 4> kTypes{2, 21, 24, 25};

enum class Fate : std::uint8_t { Comes, LostOnTheWay, NeverSent, DroppedHere, Damaged };

/// One datagram that is due.
struct Due {
    int host = 0;
    int character = 0;
    std::uint8_t type = 2;
    std::uint32_t tick = 0; ///< of the stage
    std::uint32_t sample = 0;
    log::Stamp stamp{};
    std::uint8_t part = 0;
    bool isLast = true;
    Fate fate = Fate::Comes;
    bool isTwice = false;
};

class Stage {
public:
    explicit Stage(int seed) : m_random(static_cast<std::uint64_t>(seed)) {
        constexpr std::array kRates{60.0, 100.0, 240.0};
        m_rate = kRates[pick(kRates.size())];
        m_hosts = 1 + static_cast<int>(pick(4));
        m_ticks = static_cast<std::uint32_t>(12 * m_rate);
        fill();
        double at = uniform(3, 5);
        for (std::uint64_t faults = 1 + pick(4); faults > 0; --faults) {
            at = breakAt(at) + (pick(2) == 0 ? uniform(0.05, 0.4) : uniform(0.4, 1.4));
        }
        lose();
        sort();
    }

    [[nodiscard]] const std::vector<Due>& datagrams() const { return m_datagrams; }
    [[nodiscard]] const std::string& story() const { return m_story; }
    [[nodiscard]] std::uint64_t drops() const { return m_drops; } ///< how often this computer was too slow

    /// By the rules for what can be known: whose loss each one was.
    [[nodiscard]] LossCause causeOf(const Due& due) const {
        if (due.fate == Fate::DroppedHere) {
            return LossCause::ThisComputer;
        }
        if (due.fate == Fate::Damaged || m_came.contains({due.host, due.sample})) {
            return LossCause::Network;
        }
        return m_silences.contains({due.host, due.tick}) ? m_silences.at({due.host, due.tick})
                                                         : LossCause::Unknown;
    }

private:
    std::uint64_t pick(std::uint64_t of) { return m_random.bits(m_drawn++) % of; }
    double uniform(double from, double to) { return m_random.uniform(m_drawn++, from, to); }

    void fill() {
        m_drop = pick(3) == 0 ? 0 : uniform(0.0005, 0.01);
        for (int host = 0; host < m_hosts; ++host) {
            const bool isNearWrap = pick(8) == 0;
            const auto first = static_cast<std::uint32_t>(isNearWrap ? 0 - 4 * pick(300) : 4 * pick(25000));
            const int characters = 1 + static_cast<int>(pick(3));
            const std::uint64_t types = 1 + pick(kTypes.size());
            const std::uint64_t step = pick(3) == 0 ? 2 + 2 * pick(2) : 1; // of all but the first type
            const int parts = pick(4) == 0 ? 2 : 1;                        // of that
            const auto offset = log::durationOf(uniform(0, 1 / m_rate));
            const double jitter = pick(3) == 0 ? uniform(0, 0.4 / m_rate) : 0;
            const auto begin = static_cast<std::uint32_t>(pick(4) == 0 ? m_rate * uniform(0, 2) : 0);
            for (std::uint32_t tick = begin; tick < m_ticks; ++tick) {
                Due due{.host = host, .tick = tick, .sample = first + tick};
                due.stamp = log::Stamp(100s) + offset + log::durationOf(tick / m_rate + uniform(0, jitter));
                for (due.character = 0; due.character < characters; ++due.character) {
                    for (std::uint64_t type = 0; type < (tick % step == 0 ? types : 1); ++type) {
                        due.type = kTypes[type];
                        addParts(due, type == 0 ? parts : 1);
                    }
                }
            }
        }
    }
    void addParts(Due& due, int parts) {
        for (int part = 0; part < parts; ++part) {
            due.stamp += 30us;
            due.part = static_cast<std::uint8_t>(part);
            due.isLast = part + 1 == parts;
            m_datagrams.push_back(due);
        }
    }

    /// Returns when it is over, in seconds.
    double breakAt(double at) {
        const int host = static_cast<int>(pick(static_cast<std::uint64_t>(m_hosts)));
        const auto from = static_cast<std::uint32_t>(at * m_rate);
        const auto ticks = [&](double seconds) { return static_cast<std::uint32_t>(seconds * m_rate); };
        switch (pick(6)) {
        case 0:
            return silence(host, from, ticks(uniform(0.1, 1.2)), Fate::NeverSent, LossCause::Sender);
        case 1:
            return silence(host, from, 1 + static_cast<std::uint32_t>(pick(2)), Fate::LostOnTheWay,
                           LossCause::Unknown);
        case 2:
            return outage(from, ticks(uniform(0.2, 1.2)));
        case 3:
            return dropHere(at, 1 + pick(60));
        case 4:
            return damage(at);
        default:
            return restart(host, from);
        }
    }

    double silence(int host, std::uint32_t from, std::uint32_t ticks, Fate fate, LossCause cause) {
        m_story += " silence of " + std::to_string(host) + " at " + std::to_string(from / m_rate) + " for " +
                   std::to_string(ticks) + ";";
        for (Due& due : m_datagrams) {
            if (due.host == host && due.tick >= from && due.tick < from + ticks) {
                due.fate = fate;
                m_silences[{host, due.tick}] = cause;
            }
        }
        return (from + ticks) / m_rate;
    }
    double outage(std::uint32_t from, std::uint32_t ticks) {
        for (int host = 0; host < m_hosts; ++host) {
            silence(host, from, ticks, Fate::LostOnTheWay,
                    m_hosts > 1 ? LossCause::Network : LossCause::Sender);
        }
        return (from + ticks) / m_rate;
    }
    /// The next ones of all that come, as a full receive buffer loses them.
    double dropHere(double at, std::uint64_t datagrams) {
        sort();
        ++m_drops;
        m_story += " drop of " + std::to_string(datagrams) + " at " + std::to_string(at) + ";";
        const log::Stamp from = log::Stamp(100s) + log::durationOf(at);
        log::Stamp last = from;
        for (Due& due : m_datagrams) {
            if (due.stamp >= from && due.fate == Fate::Comes && datagrams > 0) {
                due.fate = Fate::DroppedHere;
                last = due.stamp;
                --datagrams;
            }
        }
        return log::secondsOf(last - log::Stamp(100s));
    }
    double damage(double at) {
        const log::Stamp from = log::Stamp(100s) + log::durationOf(at);
        for (Due& due : m_datagrams) {
            if (due.stamp >= from && due.stamp < from + 200ms && due.fate == Fate::Comes && pick(20) == 0) {
                due.fate = Fate::Damaged;
            }
        }
        m_story += " damage at " + std::to_string(at) + ";";
        return at + 0.2;
    }
    double restart(int host, std::uint32_t from) {
        m_story += " restart of " + std::to_string(host) + " at " + std::to_string(from / m_rate) + ";";
        const auto first = static_cast<std::uint32_t>(900000 - 100000 * m_restarts.size() + pick(50000));
        for (Due& due : m_datagrams) {
            if (due.host == host && due.tick >= from) {
                due.sample = first / 4 * 4 + due.tick - from / 4 * 4;
            }
        }
        m_restarts.emplace(host, from);
        return from / m_rate;
    }

    /// Single ones. Away from the ends of a run: what is lost there is not known to have been sent.
    void lose() {
        for (Due& due : m_datagrams) {
            const bool isAtRestart = isNearRestart(due);
            const bool isAtEnd = due.tick < 2.5 * m_rate || due.tick + 20 > m_ticks || isAtRestart;
            due.fate = isAtRestart && due.fate != Fate::NeverSent ? Fate::Comes : due.fate;
            if (due.fate == Fate::Comes && !isAtEnd) {
                due.fate = uniform(0, 1) < m_drop ? Fate::LostOnTheWay : Fate::Comes;
                if (uniform(0, 1) < 0.001) {
                    due.stamp += log::durationOf(uniform(0, 0.03));
                }
                due.isTwice = uniform(0, 1) < 0.0005;
            }
            if (due.fate == Fate::Comes) {
                m_came.emplace(due.host, due.sample);
            }
        }
    }
    [[nodiscard]] bool isNearRestart(const Due& due) const {
        return std::ranges::any_of(m_restarts, [&](const auto& one) {
            return one.first == due.host && due.tick + 5 > one.second && due.tick < one.second + 5;
        });
    }
    void sort() { std::ranges::stable_sort(m_datagrams, {}, &Due::stamp); }

    performer::KeyedRandom m_random;
    std::uint64_t m_drawn = 0;
    double m_rate = 60;
    double m_drop = 0;
    int m_hosts = 1;
    std::uint32_t m_ticks = 0;
    std::vector<Due> m_datagrams;
    std::set<std::pair<int, std::uint32_t>> m_came; ///< host and sample of which something came
    std::map<std::pair<int, std::uint32_t>, LossCause> m_silences;
    std::set<std::pair<int, std::uint32_t>> m_restarts;
    std::uint64_t m_drops = 0;
    std::string m_story;
};

using Key = std::tuple<int, int, std::uint8_t>; ///< host, character, type
using Sums = std::array<std::uint64_t, kLossCauses>;

class BlameTruth : public SessionTest, public testing::WithParamInterface<int> {
protected:
    void put(const Due& due, std::uint32_t drops) {
        wire::Datagram datagram{{}, bodyOf(due), {}};
        datagram.header.sampleCounter = due.sample;
        datagram.header.datagramCounter = static_cast<std::uint8_t>(due.part | (due.isLast ? 0x80 : 0));
        datagram.header.character = static_cast<std::uint8_t>(due.character);
        datagram.header.timeCode = static_cast<std::uint32_t>(due.stamp.time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        auto bytes = *wire::encode(datagram);
        bytes.resize(due.fate == Fate::Damaged ? bytes.size() - 4 : bytes.size());
        log::Arrival arrival;
        arrival.stamp = m_now = due.stamp;
        arrival.sender = sender(kHosts[static_cast<std::size_t>(due.host)]);
        arrival.kernelDropsBefore = drops;
        m_log.writer().append(bytes, arrival);
        m_log.writer().publish();
        if (m_now >= m_followed + 100ms) {
            m_session.follow(m_followed = m_now);
        }
    }
    static wire::Body bodyOf(const Due& due) {
        const float x = 1e-6F * static_cast<float>(1 + due.sample % 1000);
        switch (due.type) {
        case 2:
            return swayingAt(0, due.sample);
        case 21:
            return wire::LinearKinematics{{{1, {x, 0, 1}, {}, {}}}};
        case 24:
            return wire::CentreOfMass{.position = {x, 0, 1}};
        default:
            return wire::TimeCode{};
        }
    }
    void put(const Stage& stage) {
        std::uint32_t drops = 0;
        for (const Due& due : stage.datagrams()) {
            drops += due.fate == Fate::DroppedHere ? 1 : 0;
            if (due.fate == Fate::Comes || due.fate == Fate::Damaged) {
                for (int times = due.isTwice ? 2 : 1; times > 0; --times) {
                    put(due, std::exchange(drops, 0));
                }
            }
        }
        m_session.follow(m_now + 5s);
    }
    Sums saidOf(const Key& key) {
        const auto& [host, number, type] = key;
        const CharacterKey who{sender(kHosts[static_cast<std::size_t>(host)]),
                               static_cast<std::uint8_t>(number)};
        const Character* character = m_session.roster().find(who);
        EXPECT_NE(character, nullptr);
        for (const Stream* stream : character->streams) {
            if (stream->key.type == type) {
                return stream->lostByCause();
            }
        }
        return {};
    }
    log::Stamp m_followed{};
};

std::map<Key, Sums> truthOf(const Stage& stage) {
    std::map<std::pair<Key, std::uint32_t>, std::optional<LossCause>> samples;
    for (const Due& due : stage.datagrams()) {
        auto& lost = samples[{Key{due.host, due.character, due.type}, due.sample}];
        if (due.fate != Fate::Comes) { // of its parts, a drop here says more than what the network lost
            lost = std::min(lost.value_or(LossCause::Unknown), stage.causeOf(due));
        }
    }
    std::map<Key, Sums> truth;
    for (const auto& [key, lost] : samples) {
        Sums& sums = truth[key.first];
        if (lost) {
            ++sums[static_cast<std::size_t>(*lost)];
        }
    }
    return truth;
}

TEST_P(BlameTruth, IsRight) {
    const Stage stage(GetParam());
    put(stage);
    for (const auto& [key, sums] : truthOf(stage)) {
        const Sums said = saidOf(key);
        SCOPED_TRACE(testing::PrintToString(key) + stage.story());
        EXPECT_EQ(std::accumulate(said.begin(), said.end(), 0U),
                  std::accumulate(sums.begin(), sums.end(), 0U));
        std::uint64_t wrong = 0;
        for (std::size_t cause = 0; cause < kLossCauses; ++cause) {
            wrong += said[cause] - std::min(said[cause], sums[cause]);
        }
        // A counter of drops does not say which of a gap they were: one that the network lost beside them.
        EXPECT_LE(wrong, stage.drops())
            << testing::PrintToString(said) << ", not " << testing::PrintToString(sums);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BlameTruth, testing::Range(0, kSeeds));

} // namespace
} // namespace posewire::model
