// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/character.h"

#include "core/model/body/points.h"
#include "core/wire/messages.h"

#include <cstdint>
#include <vector>

/// From a character to the bodies of messages, in the wire's units and frames.
namespace posewire::performer {

struct MessageDialect {
    model::PointIdCoding pointIds = model::PointIdCoding::By256;
    int firstPropId = 24;             ///< 25 in the tables of revisions E to K
    bool prefixesMetaData = true;     ///< length before the text of type 12
    bool prefixesTimeCode = true;     ///< length before the text of type 25
    bool sendsMassDerivatives = true; ///< type 24 in 36 bytes
    bool sendsRealTags = true;        ///< the tags of type 12 that are in no specification but on the wire
};

struct Subject {
    const Character& character;
    const CharacterMoment& moment;
    const MessageDialect& dialect;
    double seconds = 0;            ///< since the first frame
    std::uint64_t timeOfDayMs = 0; ///< since midnight; wraps after a day
};

/// Writes what a performer sends in every frame, one for each message type of wire::Messages that counts
/// frames.
void perform(const Subject& subject, wire::PoseEuler& message);
void perform(const Subject& subject, wire::PoseQuaternion& message);
/// The 64 markers.
void perform(const Subject& subject, wire::PointPositions& message);
/// Two tags off the body: one carried across the floor, one lying still.
void perform(const Subject& subject, wire::TagPositions& message);
void perform(const Subject& subject, wire::PoseUnity& message);
void perform(const Subject& subject, wire::JointAngles& message);
void perform(const Subject& subject, wire::LinearKinematics& message);
void perform(const Subject& subject, wire::AngularKinematics& message);
void perform(const Subject& subject, wire::TrackerKinematics& message);
void perform(const Subject& subject, wire::CentreOfMass& message);
void perform(const Subject& subject, wire::TimeCode& message);

wire::ScaleInformation scaleInformation(const Character& character);
wire::PropInformation propInformation(const Character& character, const MessageDialect& dialect);
wire::MetaData metaData(const Character& character, int characterCount, const MessageDialect& dialect);
/// All segments first, then the points in parts that fit an Ethernet frame each.
std::vector<wire::NullPose> nullPoseParts(const Character& character);

/// The wire's ID of the segment at a position of the layout.
std::uint32_t segmentId(const model::SegmentLayout& layout, int position, const MessageDialect& dialect);

} // namespace posewire::performer
