// SPDX-License-Identifier: MIT
#include "tests/core/model/content/content_fixture.h"

#include "core/model/session/roster.h"
#include "core/performer/motion.h"
#include "core/performer/noise.h"
#include "tests/core/performer/faulty_performance.h"

#include <set>

/// What `send --fault` breaks is found in time, named, and nothing else is; what the network loses beside it
/// is counted as the sender knows it.
namespace posewire::model {
namespace {

constexpr int kSeeds = 1000;

class ContentTruth : public ContentTest, public testing::WithParamInterface<int> {
protected:
    [[nodiscard]] std::uint64_t pick(std::uint64_t what, std::uint64_t of) const {
        return m_random.bits(what) % of;
    }
    /// A fault of the content from a moment on, or none.
    void draw() {
        const auto kinds = performer::contentBreaks();
        const std::uint64_t kind = pick(0, kinds.size() + 2);
        const auto motions = performer::motionNames();
        m_settings.seed = static_cast<std::uint64_t>(GetParam());
        m_settings.motion = motions[pick(1, motions.size())];
        m_settings.characters = 1 + static_cast<int>(pick(2, 2));
        m_settings.types = pick(3, 2) == 0 ? std::vector<std::uint8_t>{2, 12, 13}
                                           : std::vector<std::uint8_t>{2, 12, 13, 24, 25};
        m_faults.seed = m_settings.seed;
        // Without a null pose no convention is known.
        const bool needsAll = kind < kinds.size() && kinds[kind] == "convention";
        m_faults.drop = pick(4, 2) == 0 && !needsAll ? 0.01 : 0;
        if (kind < kinds.size()) {
            m_faults.content = {std::string(kinds[kind]), 0.1 * static_cast<double>(pick(5, 12))};
        }
    }
    [[nodiscard]] std::string what() const { return m_faults.content ? m_faults.content->kind : "nothing"; }

    performer::KeyedRandom m_random{static_cast<std::uint64_t>(GetParam())};
    performer::FaultSettings m_faults;
};

TEST_P(ContentTruth, IsTold) {
    draw();
    const double from = m_faults.content ? m_faults.content->fromSeconds : 0;
    performer::Truth truth;
    for (const performer::Sending& sending : performer::performWithFaults(m_settings, m_faults, from + 2)) {
        send(sending.bytes, stampOf(0) + sending.due);
        truth.add(sending);
    }
    m_session.follow(m_now);
    std::set<std::pair<std::string_view, std::optional<CharacterKey>>> found;
    for (const Incident& one : m_session.verdicts().incidents().all()) {
        if (one.kind == IncidentKind::Content || one.kind == IncidentKind::Scale) {
            found.emplace(factsOf(one.what).word, one.character());
        }
    }
    const std::string word = what() == "floor" ? "convention" : what();
    const bool isContent = m_faults.content && word != "header";
    EXPECT_EQ(found.size(), isContent ? m_settings.characters : 0) << testing::PrintToString(told());
    EXPECT_TRUE(std::ranges::all_of(found, [&](const auto& one) { return one.first == word; }))
        << what() << ": " << testing::PrintToString(told());
    EXPECT_TRUE(!isContent || verdict().state != TakeVerdict::State::Good);
    EXPECT_EQ(of(IncidentKind::Malformed).empty(), what() != "header");
    if (what() == "counter") {
        return; // what the network lost of it cannot be seen
    }
    for (const auto& [key, stream] : truth.streams()) {
        if (!countsSamples(key.type)) {
            continue;
        }
        const Character* character = m_session.roster().find(
            CharacterKey{m_session.roster().listed().front()->key.sender, key.character});
        ASSERT_NE(character, nullptr);
        const auto ours =
            std::ranges::find(character->streams, key.type, [](const Stream* one) { return one->key.type; });
        ASSERT_NE(ours, character->streams.end());
        const StreamCounts counts = (*ours)->accounting.counts();
        const performer::SentFigures sent = stream.figures();
        EXPECT_EQ(counts.samples, sent.samples) << what() << ", type " << int(key.type);
        EXPECT_EQ(counts.lost, sent.lost);
        EXPECT_EQ(counts.duplicates + counts.incomplete, 0U);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ContentTruth, testing::Range(0, kSeeds));

} // namespace
} // namespace posewire::model
