/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "facts.h"

const quantity_facts quantities[Q_COUNT] = {
    [Q_SHIFT] = {"shift", false},
    [Q_LAW] = {"law", false},
    [Q_LAW_OUTSIDE] = {"law_outside", false},
    [Q_C1] = {"C1", false},
    [Q_C2] = {"C2", false},
    [Q_STORAGE] = {"storage", true},
    [Q_LOSS] = {"loss", true},
    [Q_EQUILIBRIUM] = {"equilibrium", false},
    [Q_PRONY_STORAGE] = {"prony_storage", true},
    [Q_PRONY_LOSS] = {"prony_loss", true},
    [Q_HYSTERESIS] = {"hysteresis", true},
    [Q_AREA] = {"area", true},
    [Q_FRICTION] = {"friction", true},
    [Q_THICKNESS] = {"thickness", true},
    [Q_HYSTERESIS_KEPT] = {"hysteresis_kept", true},
    [Q_AREA_KEPT] = {"area_kept", true},
    [Q_MODULUS] = {"modulus", true},
    [Q_DEPTH] = {"depth", true},
    [Q_FACTOR] = {"factor", true},
    [Q_GROUP_MODULUS] = {"group_modulus", true},
    [Q_RATIO] = {"ratio", true},
    [Q_LAYERED_FRICTION] = {"layered_friction", true},
    [Q_DWELL_STORAGE] = {"dwell_storage", true},
    [Q_DWELL_LOSS] = {"dwell_loss", true},
};
