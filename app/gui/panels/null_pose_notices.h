// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/body/null_pose_findings.h"

#include <QTextBrowser>

#include <vector>

namespace posewire::gui {

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
    void changeEvent(QEvent* event) override;

private:
    void write();

    std::vector<model::NullPoseFinding> m_findings;
};

} // namespace posewire::gui
