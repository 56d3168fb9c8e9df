// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_model.h"
#include "app/gui/theme/theme.h"
#include "tests/app/gui/panels/panel_stage.h"
#include "tests/support/hostile_text.h"

#include <QAbstractItemView>
#include <QAction>
#include <QLabel>
#include <QTextBrowser>
#include <QTextDocument>

#include <memory>
#include <numeric>

namespace posewire::gui {

namespace {

bool isEscapedToolTip(const QString& toolTip) {
    const QString begin = QStringLiteral("<qt><span style=\"white-space:pre-wrap\">");
    const QString end = QStringLiteral("</span></qt>");
    const QString inside = toolTip.mid(begin.size()).chopped(end.size());
    return toolTip.startsWith(begin) && toolTip.endsWith(end) && !inside.contains(QLatin1Char('<'));
}

/// Sends a name in every place that has one, and looks at all that any panel shows then.
class HostileNamesTest : public testing::TestWithParam<std::string> {
protected:
    HostileNamesTest() {
        const std::string& name = GetParam();
        for (int round = 0; round < 2; ++round) {
            const std::string text = name + std::to_string(round);
            m_stage.sendMetadata("name:" + text + "\n", at(0));
            m_stage.sendMetadata(text + ":1\n", at(1));
            m_stage.sendMetadata("note:" + text + "\n", at(2));
            wire::PropInformation props;
            props.props = {{24, text}};
            m_stage.send(props, 0, 0, at(3));
            wire::NullPose segments;
            for (int i = 0; i < 23; ++i) {
                segments.segments.push_back({i == 3 || i == 4 ? text.substr(0, 20'000) : "S", {0, 0, 1}});
            }
            m_stage.send(segments, 0, 0, at(4));
            wire::NullPose points;
            points.segments = segments.segments;
            points.segments[3].name = points.segments[4].name = "S";
            points.points = {{1, 1, text, 0, {0, 0, 0}}, {99, 2, "p", 0, {0, 0, 0}}};
            m_stage.send(points, 0, 0, at(5));
            m_stage.send(smallPose(), static_cast<std::uint32_t>(round + 1), 0, at(6));
        }
        m_stage.sendBytes(std::as_bytes(std::span(name.data(), std::min<std::size_t>(name.size(), 100))),
                          at(7), "recording of " + name);
        m_stage.follow();
        m_stage.session.setComment(0, name);
        model::Selection selection;
        selection.sender = m_stage.sender();
        selection.character = m_stage.key();
        m_stage.commands.select(selection);
    }

    log::Stamp at(int step) { return Stage::kStart + ++m_steps * 10ms + step * 1ns; }

    std::vector<std::unique_ptr<Panel>> panels() {
        std::vector<std::unique_ptr<Panel>> all;
        for (const PanelInfo& info : panelTable()) {
            all.emplace_back(info.make(m_stage.parts, nullptr));
            all.back()->setObjectName(info.id);
            all.back()->resize(700, 500);
            all.back()->show();
            all.back()->refresh();
        }
        return all;
    }

    static void expectHarmless(const QString& text, const std::string& where) {
        EXPECT_EQ(test::harmIn(text.toStdString()), "") << where << ": " << text.left(300).toStdString();
    }
    static void expectToolTip(const QString& text, const std::string& where) {
        expectHarmless(text, where);
        EXPECT_TRUE(!Qt::mightBeRichText(text) || isEscapedToolTip(text)) << where << text.toStdString();
    }
    /// HTML of ours shows the name as text, and nothing in it is loaded.
    static void expectOurs(const QString& html, const std::string& where) {
        EXPECT_FALSE(html.contains(QStringLiteral("<img"), Qt::CaseInsensitive)) << where;
        EXPECT_FALSE(html.contains(QStringLiteral("<script"), Qt::CaseInsensitive)) << where;
    }

    static void expectRows(const QAbstractItemModel& model, const QModelIndex& parent,
                           const std::string& where) {
        for (int row = 0; row < model.rowCount(parent); ++row) {
            for (int column = 0; column < model.columnCount(parent); ++column) {
                const QModelIndex index = model.index(row, column, parent);
                for (int role = 0; role < Qt::UserRole + 16; ++role) {
                    const QVariant data = index.data(role);
                    if (data.typeId() != QMetaType::QString) {
                        continue;
                    }
                    const bool isGuessed =
                        role == Qt::ToolTipRole || role == Qt::WhatsThisRole || role == Qt::StatusTipRole;
                    (isGuessed ? expectToolTip : expectHarmless)(data.toString(),
                                                                 where + " role " + std::to_string(role));
                }
            }
            if (const QModelIndex first = model.index(row, 0, parent); model.hasChildren(first)) {
                expectRows(model, first, where);
            }
        }
    }

    static void expectWidget(const QWidget& widget, const std::string& where) {
        const std::string name = where + " " + widget.metaObject()->className();
        expectToolTip(widget.toolTip(), name);
        expectHarmless(widget.accessibleName(), name);
        expectHarmless(widget.accessibleDescription(), name);
        expectHarmless(widget.windowTitle(), name);
        for (const QAction* action : widget.actions()) {
            expectToolTip(action->toolTip(), name);
            expectHarmless(action->text(), name);
        }
        if (const auto* label = qobject_cast<const QLabel*>(&widget)) {
            EXPECT_NE(label->textFormat(), Qt::AutoText) << name;
            expectHarmless(label->text(), name);
            if (label->textFormat() == Qt::RichText) {
                expectOurs(label->text(), name);
            }
        }
        if (const auto* browser = qobject_cast<const QTextBrowser*>(&widget)) {
            expectHarmless(browser->toPlainText(), name);
            expectOurs(browser->toHtml(), name);
        }
        if (const auto* view = qobject_cast<const QAbstractItemView*>(&widget); view && view->model()) {
            expectRows(*view->model(), {}, name);
        }
    }

    static void expectPanel(const Panel& panel) {
        const std::string where = panel.objectName().toStdString();
        expectHarmless(panel.summary(), where + " summary");
        for (const QWidget* widget : panel.findChildren<QWidget*>()) {
            expectWidget(*widget, where);
        }
    }

    PanelStage m_stage;
    int m_steps = 0;
};

TEST_P(HostileNamesTest, AreTextInEveryPanel) {
    for (const auto& panel : panels()) {
        expectPanel(*panel);
    }
}

TEST_P(HostileNamesTest, AreTextWhereEachPacketIsLookedAt) {
    const auto all = panels();
    for (std::uint64_t packet = 0; packet < m_stage.session.end(); ++packet) {
        m_stage.commands.selectPacket(packet);
        for (const auto& panel : all) {
            const std::string id = panel->objectName().toStdString();
            panel->refresh();
            if (id == "inspector" || id == "nullpose") {
                expectPanel(*panel);
            }
        }
    }
}

TEST_P(HostileNamesTest, AreNoFormulasInTablesOfPackets) {
    PacketModel packets(m_stage.session);
    packets.refresh();
    std::vector<int> rows(static_cast<std::size_t>(packets.rowCount()));
    std::iota(rows.begin(), rows.end(), 0);
    const QString csv = packetRowsCsv(packets, rows);
    for (const char* formula : {",=", ",@", ",\"=", ",\"@", "\n=", "\n@"}) {
        EXPECT_FALSE(csv.contains(QLatin1String(formula))) << formula;
    }
    EXPECT_EQ(test::longestRun(csv.toStdString()) > 256, false);
}

INSTANTIATE_TEST_SUITE_P(Names, HostileNamesTest, testing::ValuesIn(test::hostileNames()),
                         [](const auto& name) { return std::to_string(name.index); });

TEST(PlainText, IsNeverTakenForHtml) {
    for (const QString& text :
         {QStringLiteral("<b>x</b>"), QStringLiteral("&lt;b>"), QStringLiteral("<qt>")}) {
        const QString toolTip = toolTipText(text);
        EXPECT_TRUE(isEscapedToolTip(toolTip));
        QTextDocument document;
        document.setHtml(toolTip);
        EXPECT_EQ(document.toPlainText(), text);
    }
    EXPECT_EQ(toolTipText(QStringLiteral("1 < 2\n<b>")), QStringLiteral("1 < 2\n<b>"));
    EXPECT_EQ(menuText(QStringLiteral("Tom & Jerry\nx")), QStringLiteral("Tom && Jerry x"));
    EXPECT_EQ(menuText(QString(1'000, QLatin1Char('x'))).size(), 80);
}

} // namespace
} // namespace posewire::gui
