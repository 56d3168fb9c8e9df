// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/null_pose_notices.h"

#include "app/gui/models/null_pose_reading.h"
#include "app/gui/theme/theme.h"

#include <QEvent>

#include <algorithm>

namespace posewire::gui {

NullPoseNotices::NullPoseNotices(QWidget* parent) : QTextBrowser(parent) {
    setAccessibleName(tr("Contradictions in scale messages"));
    setFrameShape(QFrame::NoFrame);
    setStyleSheet(QStringLiteral("QTextBrowser { border: none; border-radius: 0; padding: 0; }"));
    setOpenLinks(false);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    document()->setDocumentMargin(fontMetrics().height() * 0.35);
    connect(this, &QTextBrowser::anchorClicked, this,
            [this](const QUrl& url) { emit segmentPicked(url.path().toInt()); });
}

void NullPoseNotices::setFindings(const std::vector<model::NullPoseFinding>& findings) {
    m_findings = findings;
    setVisible(!m_findings.empty());
    write();
}

void NullPoseNotices::write() {
    const Theme& colours = theme();
    QString html;
    for (const model::NullPoseFinding& finding : m_findings) {
        const Health health = healthOf(finding.severity);
        const QColor colour = health == Health::Unknown ? colours.dim : healthColour(health);
        const QString symbol = health == Health::Unknown ? QStringLiteral("○") : healthSymbol(health);
        QString what = QString::fromStdString(finding.what).toHtmlEscaped();
        if (finding.segment >= 0) {
            what = QStringLiteral("<a href=\"%1\" style=\"color:%2;text-decoration:none\">%3</a>")
                       .arg(finding.segment)
                       .arg(colours.text.name(), what);
        }
        html += QStringLiteral("<p style=\"margin:0 0 %1px 0\"><span style=\"color:%2\">%3</span> "
                               "<span style=\"color:%4\">%5</span> <span style=\"color:%6\">%7</span></p>")
                    .arg(fontMetrics().height() / 3)
                    .arg(colour.name(), symbol, colours.text.name(), what, colours.dim.name(),
                         QString::fromStdString(finding.meaning).toHtmlEscaped());
    }
    setHtml(html);
}

void NullPoseNotices::fitHeight(int most) {
    document()->setTextWidth(viewport()->width());
    const int needed = static_cast<int>(document()->size().height()) + 2;
    setFixedHeight(std::clamp(needed, fontMetrics().height(), std::max(most, fontMetrics().height() * 3)));
}

void NullPoseNotices::changeEvent(QEvent* event) {
    QTextBrowser::changeEvent(event);
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
        write();
    }
}

} // namespace posewire::gui
