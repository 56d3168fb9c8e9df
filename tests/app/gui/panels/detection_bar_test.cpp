// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/detection_bar.h"

#include "app/gui/models/stream_state.h"
#include "tests/app/gui/models/stage.h"

#include <QLabel>
#include <QMenu>

namespace posewire::gui {
namespace {

class DetectionBarTest : public testing::Test {
protected:
    void SetUp() override {
        m_stage.send(smallPose(), 1, 0, Stage::kStart);
        m_stage.follow();
        m_bar.showSource(m_stage.source());
    }

    /// Chooses from the menu of the button whose text begins with `button`.
    void choose(const QString& button, const QString& text) {
        for (QToolButton* one : m_bar.findChildren<QToolButton*>()) {
            for (QAction* action : one->menu()->actions()) {
                if (one->text().startsWith(button) && action->text() == text) {
                    action->trigger();
                    m_bar.showSource(m_stage.source());
                    return;
                }
            }
        }
        ADD_FAILURE() << button.toStdString() << " has no " << text.toStdString();
    }
    QString contradictions() const { return m_bar.findChild<QLabel*>()->text(); }
    const model::Source& source() const { return m_stage.session.sources().front(); }

    Stage m_stage;
    DetectionBar m_bar{m_stage.session, m_stage.commands, nullptr};
};

TEST_F(DetectionBarTest, DeclaresRevisionAndUnitOfTheSource) {
    choose("Revision", "J or K");
    choose("Units", "centimetres");
    EXPECT_EQ(source().overrides.revision, model::Revision::JOrK);
    EXPECT_EQ(source().overrides.positionUnit, model::LengthUnit::Centimetre);
    choose("Revision", "automatic");
    EXPECT_FALSE(source().overrides.revision);
    EXPECT_EQ(source().overrides.positionUnit, model::LengthUnit::Centimetre);
}

TEST_F(DetectionBarTest, SaysWhatContradictsTheDeclaration) {
    EXPECT_TRUE(contradictions().isEmpty());
    choose("Revision", "J or K");
    EXPECT_EQ(contradictions(), QStringLiteral("▲ declared J or K, but header counts are filled"));
    EXPECT_EQ(sourceState(m_stage.session, source()).text, "declared J or K, sends counts");
    choose("Revision", "L to N");
    EXPECT_TRUE(contradictions().isEmpty());
}

TEST_F(DetectionBarTest, IsHiddenWithoutASource) {
    m_bar.showSource(std::nullopt);
    EXPECT_TRUE(m_bar.isHidden());
}

} // namespace
} // namespace posewire::gui
