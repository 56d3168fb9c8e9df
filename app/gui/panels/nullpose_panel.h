// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/base/saving.h"
#include "app/gui/models/column.h"
#include "app/gui/models/null_pose_table.h"
#include "app/gui/panels/null_pose_figure.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"
#include "core/export/formats.h"

#include <QSplitter>
#include <QTabWidget>
#include <QTextBrowser>
#include <QToolButton>
#include <Qt>

namespace posewire::gui {

class ElidedLabel;

/// What contradicts itself in scale messages, in words: gravest first, each with what it means. As high as
/// its text, up to a share of the dock; selectable, and a finding about a segment is a link to it.
class NullPoseNotices final : public QTextBrowser {
    Q_OBJECT

public:
    explicit NullPoseNotices(QWidget* parent = nullptr);

    void setFindings(const std::vector<model::NullPoseFinding>& findings);

    /// Pixels that the text needs, but not more than `most`.
    void fitHeight(int most);

signals:
    /// A body segment.
    void segmentPicked(int segment);

protected:
    /// Nothing: whatever was sent, no file is read for it.
    QVariant loadResource(int /*type*/, const QUrl& /*name*/) override { return {}; }

private:
    void write();

    std::vector<model::NullPoseFinding> m_findings;
};

/// Dock `nullpose`: the body that scale messages (types 13, 10, 11) describe, what contradicts itself in
/// them, and what changed.
class NullPosePanel final : public Panel {
    Q_OBJECT

public:
    NullPosePanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;

    /// Writes what is shown to a file, in the format of the name's suffix. Returns what went wrong, empty for
    /// nothing.
    [[nodiscard]] QString save(const QString& path) const;
    [[nodiscard]] static std::span<const ActionInfo> actionTable();
    void exportFile();
    void copyCsv() { copyAs(exporting::formatFor<exporting::NullPoseSheet>(".csv")); }
    void copyJson() { copyAs(exporting::formatFor<exporting::NullPoseSheet>(".json")); }
    void copyContradictions() { copyText(findingsText(m_reading.findings())); }

private:
    using SheetFormat = exporting::Format<exporting::NullPoseSheet>;

    void makeTables();
    void makeButtons();
    void layOut();
    void arrange();
    void followSelection();
    void selectPlace(int place);
    void selectPoint(int point);
    /// Asks for a name that ends as the format's files do.
    void chooseFile(const SheetFormat& format, const QString& filters);
    void copyAs(const SheetFormat& format) { copyText(QString::fromStdString(format.write(sheet()))); }
    [[nodiscard]] exporting::NullPoseSheet sheet() const;
    void showContent();
    [[nodiscard]] QString emptyText() const;

    NullPoseReading m_reading{m_view};
    NullPoseSegmentModel m_segments{m_reading};
    NullPosePointModel m_points{m_reading};
    NullPoseLengthModel m_lengths{m_reading};
    NullPoseScaleModel m_scale{m_reading};
    PropertyModel m_facts;
    NullPoseNotices* m_notices = new NullPoseNotices(this);
    QSplitter* m_splitter = new QSplitter(Qt::Vertical, this);
    QSplitter* m_overview = new QSplitter(Qt::Horizontal, this);
    NullPoseFigure* m_figure = new NullPoseFigure(m_reading, this);
    TableView* m_factTable = new TableView(tr("Scale messages"), this);
    QTabWidget* m_tabs = new QTabWidget(this);
    TableView* m_segmentTable = new TableView(tr("Segments of the null pose"), this);
    TableView* m_pointTable = new TableView(tr("Points of the null pose"), this);
    TableView* m_lengthTable = new TableView(tr("Lengths, left and right"), this);
    TableView* m_scaleTable = new TableView(tr("Scale information, type 10"), this);
    QToolButton* m_ghost;
    QToolButton* m_export;
    ElidedLabel* m_comparison; ///< with what "Δ ref" compares
    QWidget* m_noticeLine = new Line(this);
    int m_point = -1;
    bool m_isFollowing = false;
    bool m_isRoomy = true;    ///< the overview has its own room, else it is a tab
    bool m_isDivided = false; ///< from then on the operator's division counts
};

} // namespace posewire::gui
