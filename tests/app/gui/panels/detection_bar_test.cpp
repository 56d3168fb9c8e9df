// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/metadata_panel.h"

#include "core/model/session/roster.h"
#include "tests/app/gui/models/stage.h"

#include <QLabel>
#include <QMenu>

#include <algorithm>

namespace posewire::gui {
namespace {

class DetectionBarTest : public testing::Test {
protected:
    void SetUp() override {
        m_stage.send(smallPose(), 1, 0, Stage::kStart);
        m_stage.follow();
        m_bar.showSender(m_stage.sender());
    }

    /// Chooses from the menu of the button whose text begins with `button`.
    void choose(const QString& button, const QString& text) {
        for (QToolButton* one : m_bar.findChildren<QToolButton*>()) {
            for (QAction* action : one->menu()->actions()) {
                if (one->text().startsWith(button) && action->text() == text) {
                    action->trigger();
                    m_bar.showSender(m_stage.sender());
                    return;
                }
            }
        }
        ADD_FAILURE() << button.toStdString() << " has no " << text.toStdString();
    }
    QToolButton* button(const QString& begin) const {
        const auto buttons = m_bar.findChildren<QToolButton*>();
        const auto found = std::ranges::find_if(
            buttons, [&](const QToolButton* one) { return one->text().startsWith(begin); });
        return found != buttons.end() ? *found : nullptr;
    }
    QString contradictions() const { return m_bar.findChild<QLabel*>()->text(); }
    const model::Sender& sender() const { return m_stage.session.roster().senders().front(); }

    Stage m_stage;
    DetectionBar m_bar{m_stage.session, m_stage.commands, nullptr};
};

TEST_F(DetectionBarTest, DeclaresRevisionAndUnitOfTheSender) {
    choose("Revision", "J or K");
    choose("Units", "centimetres");
    EXPECT_EQ(sender().overrides.revision, model::Revision::JOrK);
    EXPECT_EQ(sender().overrides.positionUnit, model::LengthUnit::Centimetre);
    choose("Revision", "automatic");
    EXPECT_FALSE(sender().overrides.revision);
    EXPECT_EQ(sender().overrides.positionUnit, model::LengthUnit::Centimetre);
}

TEST_F(DetectionBarTest, DeclaresTheAxisThatIsUp) {
    choose("Up", "Y-up");
    EXPECT_EQ(sender().overrides.up, model::UpAxis::Y);
    EXPECT_EQ(sender().up(), model::UpAxis::Y);
    EXPECT_NE(button("Up: Y-up"), nullptr);
    choose("Up", "Z-up");
    EXPECT_EQ(sender().overrides.up, model::UpAxis::Z);
    EXPECT_EQ(sender().overrides.revision, std::nullopt);
    choose("Up", "automatic");
    EXPECT_EQ(sender().overrides.up, std::nullopt);
    EXPECT_NE(button("Up: auto"), nullptr);
}

TEST_F(DetectionBarTest, IsDeclaredFromTheMenuOfTheSenderAsWell) {
    MetadataPanel panel{m_stage.session, m_stage.commands, nullptr};
    panel.refresh();
    using Declared = std::optional<model::UpAxis>;
    for (const auto& [id, up] : std::initializer_list<std::pair<std::string_view, Declared>>{
             {"upY", model::UpAxis::Y}, {"upZ", model::UpAxis::Z}, {"upAutomatic", std::nullopt}}) {
        const auto entries = MetadataPanel::actionTable();
        const auto entry = std::ranges::find(entries, id, &ActionInfo::id);
        ASSERT_NE(entry, entries.end());
        entry->run(panel);
        EXPECT_EQ(sender().overrides.up, up) << id;
        EXPECT_TRUE(entry->isOn(panel)) << id;
    }
}

TEST_F(DetectionBarTest, SaysWhatContradictsTheDeclaration) {
    EXPECT_TRUE(contradictions().isEmpty());
    choose("Revision", "J or K");
    EXPECT_EQ(contradictions(), QStringLiteral("▲ declared J or K, but header counts are filled"));
    choose("Revision", "L to N");
    EXPECT_TRUE(contradictions().isEmpty());
}

TEST_F(DetectionBarTest, IsHiddenWithoutASender) {
    m_bar.showSender(std::nullopt);
    EXPECT_TRUE(m_bar.isHidden());
}

} // namespace
} // namespace posewire::gui
