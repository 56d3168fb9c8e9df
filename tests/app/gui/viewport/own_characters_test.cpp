// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/own_characters.h"

#include "app/gui/models/text.h"
#include "app/gui/viewport/picking.h"
#include "app/gui/viewport/view_look.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/models/stage.h"
#include "tests/support/paths.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QThreadPool>

#include <gtest/gtest.h>

#include <future>

namespace posewire::gui {
namespace {

const QString kMannequin = QString::fromStdString(test::sourcePath("resources/mannequin_low.glb").string());

class OwnCharactersTest : public testing::Test {
protected:
    OwnCharactersTest() {
        const ReadCharacter read = readCharacterFile(kMannequin);
        EXPECT_TRUE(read) << read.error().toStdString();
        m_file = read.value_or(nullptr);
    }

    void dress(const QString& name, const BodyChoice& choice) {
        const auto body = bodyOf(*m_file, choice);
        ASSERT_TRUE(body) << body.error().toStdString();
        m_characters.dress(name, m_file, choice, *body);
    }
    BodyChoice found() const { return choiceOf({}); }
    static bool waitFor(OwnCharacters& characters) {
        return QTest::qWaitFor([&] { return !characters.isRestoring(); }, 20'000);
    }

    std::shared_ptr<const CharacterFile> m_file;
    OwnCharacters m_characters;
    QTemporaryDir m_folder;
};

TEST_F(OwnCharactersTest, ReadsAFile) {
    EXPECT_EQ(m_file->character.bones.size(), render::kJointCount);
    EXPECT_EQ(m_file->sum.size(), 64);
    EXPECT_TRUE(m_file->remarks.isEmpty());
}

TEST_F(OwnCharactersTest, SaysWhatIsWrongWithAFile) {
    const QString path = m_folder.filePath("broken.glb");
    QFile file(path);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("glTF, but not really");
    file.close();
    const ReadCharacter broken = readCharacterFile(path);
    ASSERT_FALSE(broken);
    EXPECT_TRUE(broken.error().contains("broken.glb")) << broken.error().toStdString();
    const ReadCharacter gone = readCharacterFile(m_folder.filePath("gone.glb"));
    ASSERT_FALSE(gone);
    EXPECT_TRUE(gone.error().contains("cannot be opened"));
}

TEST_F(OwnCharactersTest, KeepsChoices) {
    BodyChoice choice = found();
    choice.rest = {0.01F, 3, false};
    choice.isScaled = false;
    EXPECT_EQ(choiceOf(jsonOf(*m_file, choice)), choice);
}

TEST_F(OwnCharactersTest, TakesValuesThatMakeNoSenseForUnknown) {
    QJsonObject kept = jsonOf(*m_file, found());
    kept["unit"] = -5;
    kept["quarterTurns"] = 1'001;
    const BodyChoice choice = choiceOf(kept);
    EXPECT_EQ(choice.rest.unit, 0.0F);
    EXPECT_EQ(choice.rest.quarterTurns, 1);
}

TEST_F(OwnCharactersTest, DressesOneOrAll) {
    QSignalSpy changed(&m_characters, &OwnCharacters::changed);
    dress({}, found());
    EXPECT_NE(m_characters.wardrobe().of("Alice"), nullptr);
    BodyChoice other = found();
    other.isScaled = false;
    dress("Alice", other);
    EXPECT_NE(m_characters.wardrobe().of("Alice"), m_characters.wardrobe().of("Bob"));
    m_characters.undress({});
    EXPECT_EQ(m_characters.wardrobe().of("Bob"), nullptr);
    EXPECT_NE(m_characters.wardrobe().of("Alice"), nullptr);
    EXPECT_EQ(changed.size(), 3);
}

TEST_F(OwnCharactersTest, ComeBackInTheNextRun) {
    BodyChoice choice = found();
    choice.isScaled = false;
    dress("Alice", choice);
    dress({}, found());
    OwnCharacters next;
    next.restoreState(m_characters.state());
    EXPECT_EQ(next.wardrobe().of("Alice"), nullptr) << "read meanwhile";
    ASSERT_TRUE(waitFor(next));
    ASSERT_NE(next.wardrobe().of("Alice"), nullptr);
    EXPECT_FALSE(next.wardrobe().of("Alice")->isScaled);
    EXPECT_TRUE(next.wardrobe().of("Bob")->isScaled);
    EXPECT_EQ(next.state(), m_characters.state());
}

TEST_F(OwnCharactersTest, AMissingFileLeavesTheMannequinAndIsSaidAndRemembered) {
    dress("Alice", found());
    QJsonArray state = m_characters.state();
    QJsonObject entry = state[0].toObject();
    entry["file"] = m_folder.filePath("moved.glb");
    state[0] = entry;
    OwnCharacters next;
    QSignalSpy failed(&next, &OwnCharacters::failed);
    next.restoreState(state);
    ASSERT_TRUE(waitFor(next));
    ASSERT_EQ(failed.size(), 1);
    EXPECT_TRUE(failed[0][0].toString().startsWith("The mannequin stays: "))
        << failed[0][0].toString().toStdString();
    EXPECT_TRUE(failed[0][0].toString().contains("moved.glb"));
    EXPECT_EQ(next.wardrobe().of("Alice"), nullptr);
    EXPECT_EQ(next.state(), state) << "the disk may come back";
}

TEST_F(OwnCharactersTest, IgnoresStatesThatAnyoneMayHaveWritten) {
    QJsonArray state{QJsonValue(7), QJsonObject{{"file", 3}}, QJsonObject{}};
    OwnCharacters next;
    next.restoreState(state);
    EXPECT_FALSE(next.isRestoring());
    EXPECT_TRUE(next.state().isEmpty());
}

class DressedScene : public OwnCharactersTest {
protected:
    SceneFrame build() {
        SceneFrame frame;
        m_builder.setWardrobe(m_characters.wardrobe());
        m_builder.build(AxesMode::None, {}, frame);
        return frame;
    }
    void SetUp() override {
        performer::Performer performer(sending(2, {2, 12, 13}));
        m_stage.perform(performer, 0, 3);
        m_stage.follow();
    }

    Stage m_stage;
    SceneBuilder m_builder{m_stage.session, render::Detail::Medium};
};

TEST_F(DressedScene, ShowsTheOwnBodyOfWhoHasOneInThePoseThatIsSent) {
    const SceneFrame plain = build();
    ASSERT_EQ(plain.figures.size(), 2U);
    EXPECT_EQ(plain.figures[0].own, nullptr);
    dress(shown(m_stage.session.roster().displayName(plain.figures[0].key)), found());
    const SceneFrame frame = build();
    ASSERT_NE(frame.figures[0].own, nullptr);
    EXPECT_EQ(frame.figures[1].own, nullptr);
    const Figure& figure = frame.figures[0];
    const render::OwnBody& body = figure.own->dressed->body;
    for (const render::Segment segment : {render::Head, render::LeftHand, render::RightFoot}) {
        const auto joint = static_cast<std::size_t>(body.segmentJoints[segment]);
        const glm::vec3 place =
            render::transformPoint(figure.bones[joint], figure.own->scale * body.joints[joint].origin);
        const glm::vec3 sent =
            render::transformPoint(figure.palette[segment], figure.body->fit.origins[segment]);
        EXPECT_LT(glm::distance(place, sent), 0.06F)
            << render::kJointNames[segment] << ": the same body, but for its own proportions";
    }
    EXPECT_NEAR(figure.labelPosition.z, plain.figures[0].labelPosition.z, 0.08F);
    EXPECT_EQ(m_builder.ownFigures().memoryBytes(), 2 * figure.own->dressed->meshBytes());
    EXPECT_GE(m_builder.ownFigures().mostBytes(), m_builder.ownFigures().memoryBytes());
}

TEST_F(DressedScene, PerformersOfOneSizeShareOneBody) {
    dress({}, found());
    const SceneFrame first = build();
    const SceneFrame again = build();
    ASSERT_NE(first.figures[0].own, nullptr);
    EXPECT_EQ(first.figures[0].own, again.figures[0].own);
}

TEST_F(DressedScene, IsPickedByItsOwnSegments) {
    dress({}, found());
    SceneFrame frame = build();
    ASSERT_EQ(frame.figures.size(), 2U);
    const Figure& figure = frame.figures[0];
    const render::OwnBody& body = figure.own->dressed->body;
    const auto joint = static_cast<std::size_t>(body.segmentJoints[render::Head]);
    const glm::vec3 head = render::transformPoint(
        figure.bones[joint], figure.own->scale * (body.joints[joint].origin + glm::vec3(0, 0, 0.08F)));
    frame.camera.target = head;
    const QSizeF view(400, 300);
    const auto picked = pickIn(frame, {200, 150}, view);
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->key, figure.key);
    EXPECT_EQ(picked->segment, render::Head);
}

TEST(CharacterReading, NeitherCallsWhoIsGoneNorForAnEarlierFile) {
    int calls = 0;
    {
        CharacterReading gone;
        gone.begin(kMannequin, [&](const ReadCharacter&) { calls += 100; });
    }
    CharacterReading reading;
    reading.begin("/nowhere/first.glb", [&](const ReadCharacter&) { calls += 10; });
    reading.begin(kMannequin, [&](const ReadCharacter& file) { calls += file ? 1 : 1'000; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return calls > 0; }, 20'000));
    QTest::qWait(0);
    EXPECT_EQ(calls, 1);
}

TEST(CharacterReading, NobodyWaitsForAFileThatIsNoLongerWanted) {
    std::promise<void> slow;
    const std::shared_future<void> isOver = slow.get_future().share();
    int calls = 0;
    const auto read = [isOver](const QString& path, bool, const std::atomic<bool>*) {
        if (path == "slow") {
            isOver.wait();
        }
        return ReadCharacter(nullptr);
    };
    {
        CharacterReading reading(read);
        reading.begin("slow", [&](const ReadCharacter&) { calls += 100; });
        reading.begin("quick", [&](const ReadCharacter&) { ++calls; });
        EXPECT_TRUE(QTest::qWaitFor([&] { return calls != 0; }, 10'000)) << "not held up by the slow one";
    }
    slow.set_value();
    QThreadPool::globalInstance()->waitForDone();
    QTest::qWait(0);
    EXPECT_EQ(calls, 1);
}

TEST(BoneMapping, NamesSegmentsAsEverythingElseDoes) {
    for (std::size_t i = 0; i < render::kMappableCount; ++i) {
        EXPECT_EQ(render::mappableTitle(i), model::segmentTitle(render::mappableName(i)));
    }
}

} // namespace
} // namespace posewire::gui
