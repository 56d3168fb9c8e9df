// SPDX-License-Identifier: MIT
#pragma once

#include "packaging/mannequin/primitives.h"

#include <array>
#include <span>
#include <variant>

/// The shape of the mannequin as numbers: the left half of a person of 1.75 m in the reference null pose,
/// metres, Z-up, X forward, Y left, the floor at z = 0.
namespace posewire::render::mannequin {

/// Height of the shoulder joints and of the arms' axis.
inline constexpr double kShoulderHeight = 1.4196;

/// A shape blended into, or carved out of, what its part has so far.
struct Blend {
    enum class Kind { Add, Carve };

    std::variant<Ellipsoid, Cone> shape;
    double radius;
    Kind kind = Kind::Add;
};

// place z, then centre x and y, radius x and y
inline constexpr std::array<LoftStation, 15> kTorsoStations{{
    {0.826, -0.016, 0.0, 0.036, 0.048},
    {0.850, -0.015, 0.0, 0.066, 0.102},
    {0.890, -0.014, 0.0, 0.092, 0.148},
    {0.935, -0.013, 0.0, 0.1045, 0.163},
    {0.985, -0.008, 0.0, 0.101, 0.157},
    {1.035, 0.000, 0.0, 0.093, 0.143},
    {1.090, 0.009, 0.0, 0.087, 0.130},
    {1.145, 0.014, 0.0, 0.086, 0.128},
    {1.205, 0.017, 0.0, 0.091, 0.137},
    {1.265, 0.018, 0.0, 0.099, 0.151},
    {1.320, 0.015, 0.0, 0.105, 0.161},
    {1.370, 0.008, 0.0, 0.101, 0.160},
    {1.412, -0.001, 0.0, 0.086, 0.142},
    {1.452, -0.009, 0.0, 0.066, 0.100},
    {1.490, -0.012, 0.0, 0.052, 0.060},
}};

// place z, then centre x and y, radius x and y; the top two sink into the pelvis so that no belt line shows
inline constexpr std::array<LoftStation, 18> kLegStations{{
    {0.045, -0.004, 0.0840, 0.0340, 0.0290},
    {0.075, -0.004, 0.0840, 0.0345, 0.0300},
    {0.115, -0.005, 0.0840, 0.0330, 0.0300},
    {0.165, -0.006, 0.0840, 0.0355, 0.0335},
    {0.225, -0.009, 0.0845, 0.0430, 0.0410},
    {0.290, -0.014, 0.0855, 0.0530, 0.0500},
    {0.350, -0.016, 0.0860, 0.0590, 0.0560},
    {0.405, -0.011, 0.0850, 0.0560, 0.0540},
    {0.455, -0.003, 0.0840, 0.0520, 0.0500},
    {0.505, 0.004, 0.0840, 0.0545, 0.0510},
    {0.560, 0.006, 0.0840, 0.0610, 0.0555},
    {0.630, 0.009, 0.0850, 0.0720, 0.0640},
    {0.710, 0.008, 0.0870, 0.0815, 0.0725},
    {0.790, 0.005, 0.0885, 0.0885, 0.0785},
    {0.865, -0.001, 0.0895, 0.0915, 0.0820},
    {0.925, -0.003, 0.0865, 0.0830, 0.0745},
    {0.975, -0.004, 0.0790, 0.0620, 0.0560},
    {1.020, -0.004, 0.0700, 0.0300, 0.0300},
}};

// place y, then centre x and z, radius x and z
inline constexpr std::array<LoftStation, 15> kArmStations{{
    {0.060, -0.002, kShoulderHeight - 0.012, 0.0260, 0.0260},
    {0.105, -0.002, kShoulderHeight - 0.006, 0.0440, 0.0430},
    {0.165, 0.000, kShoulderHeight, 0.0520, 0.0520},
    {0.215, 0.000, kShoulderHeight, 0.0500, 0.0510},
    {0.275, 0.002, kShoulderHeight - 0.002, 0.0460, 0.0490},
    {0.335, 0.002, kShoulderHeight - 0.002, 0.0425, 0.0450},
    {0.395, 0.000, kShoulderHeight, 0.0395, 0.0395},
    {0.445, -0.003, kShoulderHeight, 0.0385, 0.0355},
    {0.485, 0.000, kShoulderHeight, 0.0415, 0.0370},
    {0.530, 0.003, kShoulderHeight, 0.0430, 0.0375},
    {0.580, 0.003, kShoulderHeight, 0.0395, 0.0340},
    {0.630, 0.002, kShoulderHeight, 0.0335, 0.0275},
    {0.668, 0.001, kShoulderHeight, 0.0290, 0.0225},
    {0.695, 0.000, kShoulderHeight, 0.0280, 0.0200},
    {0.715, 0.000, kShoulderHeight, 0.0270, 0.0170},
}};

// place y, then centre x and z, radius x and z
inline constexpr std::array<LoftStation, 6> kPalmStations{{
    {0.672, 0.000, kShoulderHeight, 0.0200, 0.0140},
    {0.700, 0.001, kShoulderHeight, 0.0290, 0.0175},
    {0.732, 0.002, kShoulderHeight - 0.001, 0.0380, 0.0160},
    {0.762, 0.002, kShoulderHeight - 0.002, 0.0425, 0.0148},
    {0.785, 0.001, kShoulderHeight - 0.003, 0.0420, 0.0130},
    {0.798, 0.000, kShoulderHeight - 0.004, 0.0380, 0.0100},
}};

// place x, then centre y and z, radius y and z
inline constexpr std::array<LoftStation, 12> kFootStations{{
    {-0.066, 0.0840, 0.0360, 0.0100, 0.0120},
    {-0.058, 0.0840, 0.0360, 0.0220, 0.0260},
    {-0.040, 0.0840, 0.0380, 0.0300, 0.0360},
    {-0.010, 0.0840, 0.0420, 0.0335, 0.0420},
    {0.030, 0.0835, 0.0430, 0.0345, 0.0430},
    {0.065, 0.0830, 0.0370, 0.0380, 0.0370},
    {0.100, 0.0825, 0.0310, 0.0425, 0.0310},
    {0.140, 0.0825, 0.0255, 0.0465, 0.0255},
    {0.170, 0.0815, 0.0215, 0.0445, 0.0215},
    {0.192, 0.0795, 0.0205, 0.0370, 0.0205},
    {0.207, 0.0775, 0.0195, 0.0270, 0.0185},
    {0.216, 0.0760, 0.0185, 0.0130, 0.0120},
}};

// place x, then centre y and z, radius y and z; a slab as wide as the shoe and a little more
inline constexpr std::array<LoftStation, 10> kSoleStations{{
    {-0.069, 0.0840, 0.0100, 0.0120, 0.0110},
    {-0.058, 0.0840, 0.0105, 0.0245, 0.0125},
    {-0.035, 0.0840, 0.0110, 0.0325, 0.0140},
    {0.000, 0.0840, 0.0110, 0.0350, 0.0140},
    {0.050, 0.0830, 0.0105, 0.0375, 0.0130},
    {0.100, 0.0825, 0.0100, 0.0445, 0.0120},
    {0.145, 0.0825, 0.0105, 0.0475, 0.0115},
    {0.180, 0.0810, 0.0115, 0.0430, 0.0110},
    {0.206, 0.0780, 0.0130, 0.0310, 0.0115},
    {0.218, 0.0760, 0.0145, 0.0150, 0.0110},
}};

// place z, then centre x and y, radius x and y: a standing collar, wide where it sinks into the shoulders
inline constexpr std::array<LoftStation, 4> kCollarStations{{
    {1.4400, -0.0150, 0.0, 0.0560, 0.0660},
    {1.4700, -0.0105, 0.0, 0.0620, 0.0655},
    {1.4950, -0.0065, 0.0, 0.0610, 0.0615},
    {1.5230, -0.0025, 0.0, 0.0605, 0.0605},
}};

inline constexpr LoftShape kTorso{Axis::Z, kTorsoStations, 2.3, 0.020};
inline constexpr LoftShape kLeg{Axis::Z, kLegStations, 2.0, 0.020};
inline constexpr LoftShape kArm{Axis::Y, kArmStations, 2.0, 0.012};
inline constexpr LoftShape kPalm{Axis::Y, kPalmStations, 2.5, 0.008};
inline constexpr LoftShape kFoot{Axis::X, kFootStations, 2.2, 0.004};
inline constexpr LoftShape kSole{Axis::X, kSoleStations, 2.6, 0.010};
inline constexpr LoftShape kCollar{Axis::Z, kCollarStations, 2.0, 0.002};

inline constexpr std::array<Blend, 7> kTrunkBlends{{
    {Ellipsoid{{0.070, 0.066, 1.352}, {0.038, 0.085, 0.058}, {0.0, 0.0, -0.22}}, 0.050}, // pectoral sheet
    {Ellipsoid{{-0.055, 0.088, 1.368}, {0.032, 0.060, 0.078}, {0.0, 0.0, 0.25}}, 0.050}, // scapula
    {Ellipsoid{{-0.020, 0.122, 1.300}, {0.062, 0.042, 0.115}}, 0.050},                   // latissimus
    {Ellipsoid{{-0.062, 0.064, 0.900}, {0.057, 0.070, 0.074}}, 0.045},                   // gluteus
    {Ellipsoid{{-0.066, 0.000, 0.935}, {0.036, 0.050, 0.060}}, 0.040}, // sacrum, softens the cleft
    {Cone{{-0.122, 0.0, 1.00}, {-0.124, 0.0, 1.40}, 0.020, 0.020}, 0.050,
     Blend::Kind::Carve},                                                        // spinal furrow
    {Cone{{-0.016, 0.030, 1.504}, {-0.008, 0.145, 1.440}, 0.032, 0.032}, 0.050}, // trapezius
}};

inline constexpr std::array<Blend, 1> kNeckBlends{{
    {Cone{{-0.014, 0.0, 1.430}, {0.006, 0.0, 1.600}, 0.0580, 0.0535}, 0.050},
}};

// A smooth helmet without a face; its visor is paint (suit.glsl).
inline constexpr std::array<Blend, 4> kHeadBlends{{
    {Ellipsoid{{-0.004, 0.0, 1.6635}, {0.0965, 0.0765, 0.0865}}, 0.050}, // cranium
    {Ellipsoid{{0.021, 0.0, 1.6280}, {0.0745, 0.0640, 0.0760}}, 0.040},  // visor
    {Ellipsoid{{0.030, 0.0, 1.5850}, {0.0580, 0.0500, 0.0420}}, 0.050},  // jaw
    {Ellipsoid{{0.060, 0.0, 1.5640}, {0.0230, 0.0260, 0.0190}}, 0.040},  // chin
}};

inline constexpr std::array<Blend, 1> kArmBlends{{
    {Ellipsoid{{-0.002, 0.178, kShoulderHeight + 0.004}, {0.058, 0.072, 0.055}}, 0.035}, // deltoid
}};

inline constexpr std::array<Blend, 1> kLegBlends{{
    {Ellipsoid{{0.049, 0.084, 0.507}, {0.014, 0.024, 0.030}}, 0.030}, // patella
}};

inline constexpr std::array<Blend, 1> kFootBlends{{
    {Ellipsoid{{-0.006, 0.084, 0.082}, {0.036, 0.041, 0.016}}, 0.025}, // malleoli
}};

/// A digit of the left hand: its first joint of three in kReferenceHand, the radii at these and at the tip,
/// and the blend with what the hand has so far.
struct Digit {
    std::size_t firstJoint;
    std::array<double, 4> radii;
    double blend;
};

inline constexpr std::array<Digit, 5> kDigits{{
    {1, {0.0140, 0.0114, 0.0098, 0.0080}, 0.014},  // thumb
    {5, {0.0096, 0.0090, 0.0083, 0.0072}, 0.007},  // index
    {9, {0.0099, 0.0092, 0.0085, 0.0074}, 0.007},  // middle
    {13, {0.0094, 0.0088, 0.0081, 0.0070}, 0.007}, // ring
    {17, {0.0084, 0.0078, 0.0072, 0.0063}, 0.007}, // little
}};

/// The sole is cut flat at this height, with these fillets for the foot alone and for the whole body.
inline constexpr double kSoleHeight = 0.0015;
inline constexpr double kFootSoleFillet = 0.010;
inline constexpr double kBodySoleFillet = 0.004;

} // namespace posewire::render::mannequin
