// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"

#include "core/model/accounting/attribution.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/body/pose_messages.h"
#include "core/model/incidents/thresholds.h"
#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

/// What the session shows where its cursor is.
namespace posewire::model {
namespace {

class ViewTest : public SessionTest {
protected:
    void pauseAt(std::uint64_t packet) { m_session.setCursor({Cursor::Mode::Paused, packet}); }
    void goOn() { m_session.setCursor({}); }

    void sendFrom(const std::string& address, wire::Body body, std::uint32_t sample, log::Stamp stamp,
                  std::uint8_t character = 0) {
        wire::Datagram datagram{{}, std::move(body), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = character;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), stamp, address);
    }
    /// `count` poses 10 ms apart from a time on.
    void poses(std::uint32_t first, std::uint32_t count, log::Stamp from) {
        for (std::uint32_t i = 0; i < count; ++i) {
            send(standingAt(static_cast<float>(first + i)), first + i, from + i * 10ms);
        }
    }
    double pelvisX() { return m_session.messages().pose(key())->segments[0].position.x(); }
};

TEST_F(ViewTest, IsEmptyBeforeAnythingComes) {
    m_session.follow(at(5s));
    EXPECT_EQ(m_session.begin(), m_session.end());
    EXPECT_EQ(m_session.now(), at(5s));
    EXPECT_EQ(m_session.firstStamp(), log::Stamp());
    EXPECT_EQ(m_session.cursorStamp(), at(5s));
    EXPECT_TRUE(m_session.roster().listed().empty());
    EXPECT_EQ(m_session.accounts().countsOf(key(), {at(0s), at(9s)}), StreamCounts{});
    EXPECT_EQ(m_session.messages().ageSeconds(key()), 0);
    EXPECT_EQ(m_session.packet(0), std::nullopt);
    EXPECT_EQ(m_session.messages().message(key(), 2), nullptr);
    EXPECT_EQ(m_session.messages().pose(key()), nullptr);
    EXPECT_EQ(m_session.messages().nullPose(key()), nullptr);
    EXPECT_EQ(m_session.messages().visit({sender(), 0, 2}, at(0s), 10, [](const Message&) { FAIL(); }), 0U);
    pauseAt(7);
    EXPECT_EQ(m_session.cursorStamp(), at(5s)) << "there is no such packet";
    EXPECT_EQ(m_session.messages().message(key(), 2), nullptr);
    EXPECT_TRUE(m_session.verdicts().troublesOf(key()).empty());
}

TEST_F(ViewTest, FindsPacketsByTimeAsAWalkDoes) {
    std::mt19937 random(6);
    std::vector<log::Stamp> stamps;
    log::Stamp stamp = at(100s);
    for (std::uint32_t i = 0; i < 300; ++i) {
        stamp += std::chrono::milliseconds(random() % 4); // several may have the same stamp
        stamps.push_back(stamp);
        send(wire::CentreOfMass{}, i, stamp);
    }
    follow();
    for (log::Stamp asked = at(100s) - 3ms; asked < stamp + 5ms; asked += 500us) {
        std::uint64_t from = 0;
        while (from < stamps.size() && stamps[from] < asked) {
            ++from;
        }
        ASSERT_EQ(m_session.packetFrom(asked), from) << asked.time_since_epoch().count();
        std::uint64_t newest = 0;
        for (std::uint64_t i = 0; i < stamps.size(); ++i) {
            newest = stamps[i] <= asked ? i : newest;
        }
        ASSERT_EQ(m_session.packetAt(asked), newest) << asked.time_since_epoch().count();
    }
}

TEST(ViewOfALogWithHoles, FindsPacketsByTimeAroundThem) {
    log::PacketLog log({.memoryCap = std::size_t{1280} << 10, .chunkSize = std::size_t{256} << 10});
    log::PastWriter past(log.past(), log.senders(), nullptr);
    Session session(log);
    const std::vector<std::byte> bytes(700);
    const auto stampOf = [](std::uint64_t number) { return log::Stamp(1s + number * 1ms); };
    constexpr std::uint64_t kCount = 6'000;
    const log::SenderId sender = log.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
    for (std::uint64_t number = 0; number < kCount; ++number) {
        const log::Arrival arrival{stampOf(number), sender, 0, {}};
        log.writer().append(bytes, arrival);
        log.writer().publish();
        if (number < 300) { // the disk was too slow for the others
            past.keep(number, arrival, bytes);
        }
        if (number % 100 == 99) {
            session.follow(arrival.stamp);
        }
    }
    past.finish();
    session.follow(stampOf(kCount));
    const std::uint64_t behind = log.figures().begin;
    ASSERT_GT(behind, 1'000U);
    ASSERT_LT(behind, kCount - 100);
    ASSERT_EQ(session.begin(), 0U);
    for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{299}, behind, kCount - 1}) {
        EXPECT_EQ(session.packetFrom(stampOf(number)), number);
        EXPECT_EQ(session.packetAt(stampOf(number)), number);
    }
    EXPECT_EQ(session.packetFrom(stampOf(1'000)), behind);
    EXPECT_EQ(session.packetAt(stampOf(1'000)), 299U);
    EXPECT_EQ(session.packetFrom(stampOf(kCount)), kCount);
}

TEST_F(ViewTest, ShowsTheStateOfEveryPacketWhateverTheOrderOfLooking) {
    poses(1, 100, at(1s));
    follow();
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        const std::uint64_t packet = random() % 130; // beyond the newest counts as the newest
        pauseAt(packet);
        ASSERT_EQ(pelvisX(), 1.0 + static_cast<double>(std::min<std::uint64_t>(packet, 99))) << packet;
    }
    goOn();
    EXPECT_EQ(pelvisX(), 100);
}

TEST_F(ViewTest, KeepsTheNewestSampleWhenAnEarlierOneComesLate) {
    poses(1, 10, at(1s));
    poses(3, 2, at(2s)); // packets 10 and 11
    poses(5, 1, at(3s));
    follow();
    EXPECT_EQ(pelvisX(), 10);
    pauseAt(10);
    EXPECT_EQ(pelvisX(), 10);
    goOn();
    poses(1, 8, at(4s)); // the counter is set back
    follow();
    EXPECT_EQ(pelvisX(), 8);
}

TEST_F(ViewTest, KnowsTheStateOfATypeThatIsSentRarely) {
    send(wire::MetaData{true, "name:Ana\n"}, 0, at(1s));
    poses(1, 50, at(2s));
    send(wire::MetaData{true, "name:Berta\ncolor:ff0000\n"}, 0, at(3s));
    poses(51, 50, at(4s));
    follow();
    pauseAt(50);
    EXPECT_EQ(m_session.roster().displayName(key()), "Ana");
    EXPECT_EQ(m_session.roster().colour(key()), defaultColour(0)) << "its own was sent later";
    const Message* message = m_session.messages().message(key(), wire::MetaData::kType);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(message->packet, 0U);
    pauseAt(51);
    EXPECT_EQ(m_session.roster().displayName(key()), "Berta");
    EXPECT_EQ(m_session.roster().colour(key()), (Colour{1, 0, 0}));
}

TEST_F(ViewTest, HasEachTagWhereItWasLastAtAnyMoment) {
    const auto seen = [&] {
        std::map<std::uint32_t, std::pair<double, log::Stamp>> all; // x, and when
        for (const TagPlace& tag : m_session.messages().tags(key())) {
            all[tag.id] = {tag.position.x(), tag.stamp};
        }
        return all;
    };
    using Places = decltype(seen());
    send(wire::TagPositions{{{900, {0, 0, 10}}, {901, {0, 0, 20}}}}, 1, at(1s)); // cm, Y-up: x is z
    send(wire::TagPositions{{{900, {0, 0, 30}}}}, 2, at(2s));
    send(wire::TagPositions{{{902, {0, 0, 40}}, {900, {0, 0, 50}}}}, 3, at(3s));
    follow();
    const Places newest{{900, {0.5, at(3s)}}, {901, {0.2, at(1s)}}, {902, {0.4, at(3s)}}};
    EXPECT_EQ(seen(), newest);
    pauseAt(1);
    EXPECT_EQ(seen(), (Places{{900, {0.3, at(2s)}}, {901, {0.2, at(1s)}}}));
    pauseAt(0);
    EXPECT_EQ(seen(), (Places{{900, {0.1, at(1s)}}, {901, {0.2, at(1s)}}}));
    goOn();
    EXPECT_EQ(seen(), newest);
}

TEST_F(ViewTest, HasTheTagsInPlacesOfPropsAndBehindMarkers) {
    wire::PoseQuaternion pose = standingAt(0);
    pose.segments.push_back({24, {1, 0, 1}, {1, 0, 0, 0}});
    pose.segments.push_back({1234, {2, 0, 1}, {1, 0, 0, 0}});
    wire::Datagram datagram{{}, pose, {}};
    wire::completeHeader(datagram, wire::HeaderEra::Reserved);
    sendBytes(wire::encode(datagram).value(), at(1s));
    follow();
    EXPECT_EQ(m_session.messages().pose(key())->layout.props, 1);
    send(wire::PointPositions{{{113, {0, 0, 1}}, {208, {0, 0, 2}}, {4321, {0, 0, 300}}}}, 1, at(2s));
    follow();
    const auto tags = m_session.messages().tags(key());
    ASSERT_EQ(tags.size(), 2U);
    EXPECT_EQ(tags[0].id, 1234U);
    EXPECT_EQ(tags[0].position, Eigen::Vector3d(2, 0, 1));
    EXPECT_EQ(tags[0].stamp, at(1s));
    EXPECT_EQ(tags[1].id, 4321U);
    EXPECT_EQ(tags[1].position, Eigen::Vector3d(3, 0, 0));
}

TEST_F(ViewTest, ForgetsTagsThatManyDatagramsHaveLeftOut) {
    send(wire::TagPositions{{{1, {}}}}, 1, at(1s));
    for (std::uint32_t i = 2; i <= 8192; ++i) {
        send(wire::TagPositions{{{2, {}}}}, i, at(1s + i * 1ms));
    }
    follow();
    EXPECT_EQ(m_session.messages().tags(key()).size(), 2U);
    send(wire::TagPositions{{{2, {}}}}, 8193, at(20s));
    follow();
    EXPECT_EQ(m_session.messages().tags(key()).size(), 1U);
}

TEST_F(ViewTest, MeasuresAgeAtTheCursorFromWhatHadComeByThen) {
    send(standingAt(0), 1, at(1s));
    sendFrom("127.0.0.1:40001", standingAt(0), 1, at(3s), 1); // another character
    sendFrom("10.0.0.7:1", standingAt(0), 1, at(4s));         // another host
    send(wire::CentreOfMass{}, 1, at(6s));
    follow();
    m_session.follow(at(10s));
    EXPECT_DOUBLE_EQ(m_session.messages().ageSeconds(key()), 4) << "any datagram of the character counts";
    pauseAt(2);
    EXPECT_DOUBLE_EQ(m_session.messages().ageSeconds(key()), 3);
    pauseAt(3);
    EXPECT_DOUBLE_EQ(m_session.messages().ageSeconds(key()), 0);
    pauseAt(0);
    EXPECT_DOUBLE_EQ(m_session.messages().ageSeconds(key()), 0);
    EXPECT_DOUBLE_EQ(m_session.messages().ageSeconds({sender(), 9}), 0) << "there is none";
    goOn();
    m_session.follow(at(5s)); // the clock was set back
    EXPECT_DOUBLE_EQ(m_session.messages().ageSeconds(key()), 0);
}

TEST_F(ViewTest, KeepsAChosenRangeAtTheCursor) {
    poses(1, 100, at(1s));
    follow();
    EXPECT_EQ(m_session.choices().range, RangeChoice{});
    EXPECT_EQ(m_session.range(), std::nullopt);
    m_session.setRange({.last = 500ms});
    EXPECT_NE(m_session.choices().range, RangeChoice{});
    ASSERT_TRUE(m_session.range().has_value());
    // What arrives at this very moment belongs to it.
    EXPECT_EQ(m_session.range()->to, m_session.now() + 1ns);
    EXPECT_DOUBLE_EQ(m_session.range()->seconds(), 0.5);
    pauseAt(20);
    EXPECT_EQ(m_session.range()->to, at(1'200ms) + 1ns);
    const TimeRange fixed{at(1'100ms), at(1'300ms)};
    m_session.setRange({.last = 500ms, .fixed = fixed});
    EXPECT_EQ(m_session.range(), fixed) << "wherever the cursor is";
    m_session.setRange({.last = -1ns});
    EXPECT_EQ(m_session.range(), std::nullopt) << "all there is";
}

TEST_F(ViewTest, CountsForTheTakeFromTheResetOn) {
    poses(1, 100, at(1s));
    follow();
    m_session.resetForTake();
    EXPECT_EQ(m_session.choices().reset, m_session.now());
    ASSERT_TRUE(m_session.range().has_value());
    EXPECT_EQ(m_session.range()->from, m_session.choices().reset);
    pauseAt(20);
    EXPECT_EQ(m_session.range()->seconds(), 0) << "the cursor is before the take";
    m_session.setRange({});
    EXPECT_EQ(m_session.range(), std::nullopt);
}

TEST_F(ViewTest, SumsWhatItsStreamsCount) {
    for (std::uint32_t sample = 1; sample <= 200; ++sample) {
        const log::Stamp stamp = at(10s) + sample * 10ms;
        if (sample % 20 != 0) {
            send(swayingAt(0, sample), sample, stamp);
        }
        sendFrom("127.0.0.1:40001", wire::CentreOfMass{}, sample, stamp, 1);
        sendFrom("10.0.0.7:1", swayingAt(0, sample), sample, stamp);
        sendFrom("10.0.0.7:1", swayingAt(0, sample), sample, stamp); // twice
    }
    follow();
    const CharacterKey other{sender("10.0.0.7:1"), 0};
    EXPECT_EQ(m_session.accounts().countsOf(key(), kAllTime).samples, 190U);
    EXPECT_EQ(m_session.accounts().countsOf(key(), kAllTime).lost, 9U) << "the last one is not missed yet";
    EXPECT_EQ(m_session.accounts().countsOf({sender(), 1}, kAllTime).samples, 200U);
    EXPECT_EQ(m_session.accounts().countsOf(other, kAllTime).duplicates, 200U);
    EXPECT_EQ(m_session.accounts().countsOf({sender("10.0.0.8:1"), 0}, kAllTime), StreamCounts{});
    const TimeRange all{at(0s), at(100s)};
    StreamCounts ofSender;
    StreamCounts inAll;
    for (const Stream& stream : m_session.roster().streams()) {
        ofSender += stream.key.sender == sender() ? stream.accounting.counts() : StreamCounts{};
        inAll += stream.accounting.countsBetween(all.from, all.to);
    }
    EXPECT_EQ(ofSender.samples, 390U);
    EXPECT_EQ(ofSender.lost, 9U);
    EXPECT_EQ(inAll.datagrams, m_session.end());
    EXPECT_EQ(inAll.samples, 590U);
    EXPECT_EQ(m_session.accounts().countsOf(key(), all).lost, 9U);
    EXPECT_EQ(m_session.accounts().countsOf(other, {at(11s), at(12s)}).samples, 100U);
    EXPECT_EQ(m_session.accounts().countsOf(other, {at(13s), at(14s)}).samples, 0U);
}

TEST_F(ViewTest, VisitsNoMoreThanItWasAskedFor) {
    poses(1, 50, at(1s));
    follow();
    const log::StreamKey stream{sender(), 0, 2};
    std::vector<std::uint32_t> seen;
    const auto visit = [&](log::Stamp from, std::size_t most) {
        seen.clear();
        return m_session.messages().visit(stream, from, most, [&](const Message& message) {
            seen.push_back(message.datagram.header.sampleCounter);
        });
    };
    EXPECT_EQ(visit(at(1'100ms), 1'000), 40U);
    EXPECT_EQ(seen.front(), 11U) << "the one at this very stamp belongs to it";
    EXPECT_EQ(visit(at(1'100ms) + 1ns, 1'000), 39U);
    EXPECT_EQ(visit(at(1'100ms), 3), 3U);
    EXPECT_EQ(seen, (std::vector<std::uint32_t>{48, 49, 50})) << "the newest of them, oldest first";
    EXPECT_EQ(visit(at(1s), 0), 0U);
    EXPECT_EQ(visit(at(9s), 10), 0U);
    pauseAt(4);
    EXPECT_EQ(visit(at(0s), 3), 3U);
    EXPECT_EQ(seen, (std::vector<std::uint32_t>{3, 4, 5}));
    EXPECT_EQ(m_session.messages().visit({sender(), 0, 21}, at(0s), 10, [](const Message&) {}), 0U);
}

TEST_F(ViewTest, VisitsNoPartsAndNothingMalformed) {
    poses(1, 3, at(1s));
    wire::PoseQuaternion half;
    half.segments.assign(12, {1, {}, {1, 0, 0, 0}});
    send(half, 4, at(2s), 0x00);
    send(half, 4, at(2s), 0x81);
    poses(5, 2, at(3s));
    follow();
    std::vector<std::uint32_t> seen;
    EXPECT_EQ(m_session.messages().visit(
                  {sender(), 0, 2}, at(0s), 100,
                  [&](const Message& message) { seen.push_back(message.datagram.header.sampleCounter); }),
              5U);
    EXPECT_EQ(seen, (std::vector<std::uint32_t>{1, 2, 3, 5, 6}));
}

TEST_F(ViewTest, KnowsTheGapThatAPacketEnded) {
    poses(1, 50, at(10s));
    poses(54, 50, at(11s)); // three are lost
    poses(110, 50, at(12s));
    follow();
    ASSERT_EQ(m_session.accounts().attribution().gaps().size(), 2U);
    EXPECT_EQ(m_session.accounts().attribution().endedBy(49), nullptr);
    ASSERT_NE(m_session.accounts().attribution().endedBy(50), nullptr);
    EXPECT_EQ(m_session.accounts().attribution().endedBy(50)->lost, 3U);
    EXPECT_EQ(m_session.accounts().attribution().endedBy(50)->fromSample, 50U);
    EXPECT_EQ(m_session.accounts().attribution().endedBy(51), nullptr);
    EXPECT_EQ(m_session.accounts().attribution().endedBy(100)->lost, 6U);
    EXPECT_EQ(m_session.accounts().attribution().endedBy(1'000), nullptr);
    EXPECT_EQ(m_session.accounts().digests().nextProblem(0), 50U);
    EXPECT_EQ(m_session.accounts().digests().nextProblem(50), 100U);
}

TEST_F(ViewTest, ShowsEveryCharacterOnceWhoeverSendsIt) {
    sendFrom("10.0.0.5:1000", standingAt(0), 1, at(1s), 0);
    sendFrom("10.0.0.5:1000", standingAt(0), 1, at(1s), 1);
    sendFrom("10.0.0.5:1001", standingAt(0), 1, at(2s), 0); // restarted
    sendFrom("10.0.0.6:1000", standingAt(0), 1, at(3s), 0);
    follow();
    EXPECT_EQ(m_session.roster().characters().size(), 4U);
    const auto keysShown = [this] {
        std::vector<CharacterKey> keys;
        for (const Character* character : m_session.roster().listed()) {
            keys.push_back(character->key);
        }
        return keys;
    };
    const CharacterKey old{sender("10.0.0.5:1000"), 0};
    const CharacterKey second{sender("10.0.0.5:1000"), 1};
    const CharacterKey restarted{sender("10.0.0.5:1001"), 0};
    const CharacterKey elsewhere{sender("10.0.0.6:1000"), 0};
    EXPECT_EQ(keysShown(), (std::vector{restarted, second, elsewhere})) << "restarted, and in its place";
    EXPECT_EQ(m_session.roster().current(old), restarted);
    EXPECT_EQ(m_session.roster().colour(old), m_session.roster().colour(restarted));
    pauseAt(1);
    EXPECT_EQ(m_session.roster().current(old), old);
    EXPECT_EQ(m_session.roster().current({sender(), 77}), (CharacterKey{sender(), 77}));
}

TEST_F(ViewTest, FollowsALogInPortions) {
    poses(1, 10, at(1s));
    EXPECT_TRUE(m_session.follow(m_now, 4));
    EXPECT_EQ(m_session.end(), 4U);
    EXPECT_EQ(pelvisX(), 4);
    EXPECT_TRUE(m_session.follow(m_now, 100));
    EXPECT_EQ(m_session.end(), 10U);
    EXPECT_FALSE(m_session.follow(m_now, 100));
    EXPECT_EQ(m_session.firstStamp(), at(1s));
}

TEST_F(ViewTest, PrefersAPoseThatIsNewerByMoreThanAQuarterOfASecond) {
    wire::PoseEuler euler;
    euler.segments.push_back({1, {0, 104, 0}, {}});
    send(standingAt(0), 1, at(1s));
    send(euler, 1, at(1'250ms));
    follow();
    EXPECT_EQ(m_session.messages().pose(key())->type, wire::PoseQuaternion::kType);
    send(euler, 2, at(1'250ms) + 1ns);
    follow();
    EXPECT_EQ(m_session.messages().pose(key())->type, wire::PoseEuler::kType);
}

TEST_F(ViewTest, ShowsNoSegmentOfADatagramWithoutSegments) {
    send(wire::PoseQuaternion{}, 1, at(1s));
    follow();
    EXPECT_NE(m_session.messages().message(key(), 2), nullptr);
    const CharacterPose* pose = m_session.messages().pose(key());
    EXPECT_EQ(pose == nullptr ? 0
                              : std::ranges::count_if(pose->sources,
                                                      [](const SegmentSource& source) {
                                                          return source.weaker() > Provenance::Assumed;
                                                      }),
              0);
}

TEST_F(ViewTest, KeepsWhatTheOperatorChose) {
    EXPECT_EQ(m_session.choices().cursor.mode, Cursor::Mode::Following);
    EXPECT_EQ(m_session.choices().selection, Selection{});
    Selection selection;
    selection.sender = sender();
    selection.character = key();
    selection.segment = 7;
    selection.packet = 99;
    m_session.setSelection(selection);
    EXPECT_EQ(m_session.choices().selection, selection);
    m_session.setDisplayFilter("type == 02");
    EXPECT_EQ(m_session.choices().displayFilter, "type == 02");
    Thresholds limits;
    limits.lossPercent = 7;
    m_session.setThresholds(limits);
    EXPECT_EQ(m_session.verdicts().thresholds(), limits);
}

TEST_F(ViewTest, AJumpIsUndoneWithTheFilterAndTheSelectionThereWere) {
    Selection own;
    own.packet = 7;
    m_session.setSelection(own);
    m_session.setDisplayFilter("type == 02");
    EXPECT_FALSE(m_session.goBack());
    Selection there;
    there.packet = 99;
    m_session.jump(there, "type == 02");
    EXPECT_EQ(m_session.choices().filterJump(), nullptr) << "it kept the operator's filter";
    there.packet = 120;
    m_session.jump(there, "gap > 0");
    ASSERT_NE(m_session.choices().filterJump(), nullptr);
    EXPECT_EQ(m_session.choices().ownFilter(), "type == 02");
    there.packet = 130;
    m_session.jump(there, "duplicate"); // from a jump's filter to another
    EXPECT_EQ(m_session.choices().ownFilter(), "type == 02");
    m_session.goBack();
    EXPECT_EQ(m_session.choices().displayFilter, "type == 02");
    EXPECT_EQ(m_session.choices().selection.packet, 99U);
    m_session.goBack();
    EXPECT_EQ(m_session.choices().selection, own);
    EXPECT_EQ(m_session.choices().displayFilter, "type == 02");
    m_session.goBack();
    EXPECT_EQ(m_session.choices().selection, own);
}

TEST_F(ViewTest, AJumpStopsAtItsPacketAndIsUndoneWithTheMomentThereWas) {
    Selection there;
    there.packet = 99;
    m_session.jump(there, "");
    EXPECT_EQ(m_session.choices().cursor, (Cursor{Cursor::Mode::Paused, 99}));
    m_session.goBack();
    EXPECT_EQ(m_session.choices().cursor, Cursor());
}

/// A sample may come in several datagrams.
TEST_F(ViewTest, StepsFromSampleToSample) {
    for (std::uint32_t sample = 1; sample <= 4; ++sample) { // packets 0 to 7
        send(swayingAt(0, sample), sample, at(sample * 1s), 0);
        send(swayingAt(0, sample), sample, at(sample * 1s), 0x81);
    }
    follow();
    const log::StreamKey stream{sender(), 0, wire::PoseQuaternion::kType};
    m_session.setCursor({Cursor::Mode::Paused, 3});
    EXPECT_EQ(m_session.messages().packetOfSample(stream, 0), 3U);
    EXPECT_EQ(m_session.messages().packetOfSample(stream, 1), 5U);
    EXPECT_EQ(m_session.messages().packetOfSample(stream, 2), 7U);
    EXPECT_EQ(m_session.messages().packetOfSample(stream, 10), 7U);
    EXPECT_EQ(m_session.messages().packetOfSample(stream, -1), 1U);
    EXPECT_EQ(m_session.messages().packetOfSample(stream, -10), 1U);
    m_session.setCursor({Cursor::Mode::Paused, 2}); // amidst a sample
    EXPECT_EQ(m_session.messages().packetOfSample(stream, -1), 1U);
    EXPECT_EQ(m_session.messages().packetOfSample({sender(), 7, 2}, 1), std::nullopt);
}

TEST_F(ViewTest, AFilterThatIsWrittenAfterAJumpIsTheOperatorsOwn) {
    m_session.jump({}, "gap > 0");
    m_session.setDisplayFilter("gap > 1");
    EXPECT_EQ(m_session.choices().filterJump(), nullptr);
    EXPECT_EQ(m_session.choices().ownFilter(), "gap > 1");
    m_session.goBack();
    EXPECT_EQ(m_session.choices().displayFilter, "");
}

TEST_F(ViewTest, KeepsMarksAndCommentsByPacketNumber) {
    m_session.setMarked(5, true);
    m_session.setMarked(5, true);
    m_session.setMarked(9, true);
    EXPECT_EQ(m_session.choices().annotations.marks, (std::set<std::uint64_t>{5, 9}));
    m_session.setMarked(5, false);
    m_session.setMarked(77, false); // was not marked
    EXPECT_EQ(m_session.choices().annotations.marks, (std::set<std::uint64_t>{9}));
    m_session.setComment(3, "odd");
    m_session.setComment(3, "Ton ab, zweiter Versuch …");
    m_session.setComment(4, "x");
    EXPECT_EQ(m_session.choices().annotations.comments.size(), 2U);
    EXPECT_EQ(m_session.choices().annotations.comments.at(3), "Ton ab, zweiter Versuch …");
    m_session.setComment(3, "");
    m_session.setComment(8, ""); // had none
    EXPECT_EQ(m_session.choices().annotations.comments, (std::map<std::uint64_t, std::string>{{4, "x"}}));
}

} // namespace
} // namespace posewire::model
