// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/pose_banner.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/viewport_overlay.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/pose_remark.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <QEvent>
#include <QPainter>
#include <QToolButton>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kBannerEdge = 12;

/// Characters of whom the same is to be said.
struct Group {
    model::PoseRemark remark;
    std::vector<std::string> names;
};

std::vector<Group> groupsOf(const model::SessionView& session) {
    std::vector<Group> groups;
    for (const model::Character* character : session.roster().listed()) {
        if (session.roster().isHidden(character->key)) {
            continue;
        }
        model::PoseRemark remark = session.messages().poseRemark(character->key);
        if (remark.isEmpty()) {
            continue;
        }
        auto same = std::ranges::find_if(
            groups, [&remark](const Group& group) { return group.remark.lines == remark.lines; });
        if (same == groups.end()) {
            same = groups.insert(groups.end(), {std::move(remark), {}});
        }
        same->names.push_back(session.roster().displayName(character->key).shown());
    }
    std::ranges::stable_sort(groups, std::ranges::greater(),
                             [](const Group& group) { return group.remark.isAssumed; });
    return groups;
}

QString sentences(const model::PoseRemark& remark) {
    QString text;
    for (const words::Fact& line : remark.lines) {
        text += (text.isEmpty() ? QString() : QStringLiteral(". ")) + said(line, words::Form::Headline);
    }
    return text;
}

} // namespace

std::vector<PoseNote> poseNotes(const model::SessionView& session, std::size_t most) {
    const std::vector<Group> groups = groupsOf(session);
    std::vector<PoseNote> notes;
    for (const Group& group : groups) {
        if (notes.size() + 1 == most && groups.size() > most) {
            std::size_t left = 0;
            for (std::size_t i = notes.size(); i < groups.size(); ++i) {
                left += groups[i].names.size();
            }
            notes.push_back({Health::Unknown,
                             tr("%n more characters are not whole either", nullptr, static_cast<int>(left))});
            break;
        }
        notes.push_back({group.remark.isAssumed ? Health::Warning : Health::Unknown,
                         QStringLiteral("%1: %2").arg(
                             said({words::Kind::Names, {{"names", group.names}}}, words::Form::Headline),
                             sentences(group.remark))});
    }
    return notes;
}

PoseBanner::PoseBanner(Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_text(richLabel(this)),
      m_floor(framedButton(tr("Place on the floor"),
                           tr("Lift these by the height of their pelvis above the soles"), this)) {
    setObjectName(QStringLiteral("poseBanner"));
    setAccessibleName(tr("What is missing of the poses"));
    auto* column = tightColumn(this);
    column->setContentsMargins(10, 8, 10, 8);
    column->setSpacing(0);
    m_text->setWordWrap(true);
    column->addWidget(m_text);
    column->addWidget(m_floor, 0, Qt::AlignLeft);
    connect(m_floor, &QToolButton::clicked, this, [this, &commands] {
        for (const model::CharacterKey& key : m_below) {
            commands.setLifted(key, true);
        }
    });
    for (const QEvent::Type look : {QEvent::PaletteChange, QEvent::FontChange}) {
        new EventWatch(this, look, [this] { showNotes(); });
    }
    hide();
}

void PoseBanner::refresh(const model::SessionView& session, bool isInterpolated) {
    std::vector<PoseNote> notes = poseNotes(session, isInterpolated ? kMost - 1 : kMost);
    if (isInterpolated) {
        notes.push_back(
            {Health::Unknown, tr("Interpolated between samples: bodies are shown up to one sample late")});
    }
    std::vector<model::CharacterKey> below;
    for (const model::Character* character : session.roster().listed()) {
        const model::CharacterPose* pose = session.messages().pose(character->key);
        if (pose != nullptr && !session.roster().isHidden(character->key) && model::isBelowFloor(*pose)) {
            below.push_back(character->key);
        }
    }
    if (notes == m_notes && below == m_below) {
        return;
    }
    m_notes = std::move(notes);
    m_below = std::move(below);
    showNotes();
}

void PoseBanner::showNotes() {
    QStringList all;
    QString html = QStringLiteral("<table cellspacing=0 cellpadding=2>");
    for (const PoseNote& note : m_notes) {
        const bool isWarning = note.level == Health::Warning;
        html +=
            QStringLiteral(
                "<tr><td style=\"color:%1;padding-right:4px\">%2</td><td style=\"color:%3\">%4</td></tr>")
                .arg((isWarning ? healthColour(note.level) : theme().dim).name(), healthSymbol(note.level),
                     (isWarning ? theme().text : theme().dim).name(), note.text.toHtmlEscaped());
        all += note.text;
    }
    m_text->setText(html + QStringLiteral("</table>"));
    setAccessibleDescription(all.join(QStringLiteral(". ")));
    m_floor->setVisible(!m_below.empty());
    setVisible(!m_notes.empty());
    place(parentWidget()->size());
}

void PoseBanner::place(const QSize& viewport) {
    layout()->activate(); // rows within it remember the height of their last text otherwise
    const int width = std::min(viewport.width() - 2 * kBannerEdge, fontMetrics().height() * 34);
    const QSize wanted = layout()->hasHeightForWidth() ? QSize(width, layout()->totalHeightForWidth(width))
                                                       : layout()->sizeHint();
    setGeometry(kBannerEdge, viewport.height() - kBannerEdge - wanted.height(), width, wanted.height());
}

void PoseBanner::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool isWarning = !m_notes.empty() && m_notes.front().level == Health::Warning;
    paintPlate(painter, rect(), isWarning ? healthColour(Health::Warning) : theme().line, 0.9);
}

} // namespace posewire::gui
