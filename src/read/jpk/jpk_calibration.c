/* What a JPK segment says of its channels: from the numbers of a channel to voltage, deflection,
 * force and height, as its calibration slots tell.
 *
 * Signs are those of the file: force is positive when the sample pushes the tip away, the height
 * falls while the tip approaches.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"

#include <math.h>
#include <string.h>

/* In the order of the columns. */
static const wt_quantity quantities[] = {
    WT_Q_TIME,
    WT_Q_HEIGHT,
    WT_Q_FORCE,
    WT_Q_DEFLECTION,
    WT_Q_DEFLECTION_VOLTAGE,
    WT_Q_MEASURED_HEIGHT,
    WT_Q_LATERAL_DEFLECTION,
};

static const char *slot_of(const jpk_lcd *lcd, wt_quantity quantity)
{
    switch (quantity) {
    case WT_Q_FORCE:
        return "force";
    case WT_Q_DEFLECTION:
        return "distance";
    case WT_Q_DEFLECTION_VOLTAGE:
    case WT_Q_LATERAL_DEFLECTION:
        return lcd->base;
    default:
        return lcd->preferred;
    }
}

/* The chain to the slot of a quantity, in SI; false if the file does not say how. */
static bool chain_si(const jpk_lcd *lcd, force_signal *signal)
{
    const char *name = slot_of(lcd, signal->quantity);
    const jpk_slot *slot = jpk_lcd_slot(lcd, name);
    force_linear *chain = &signal->to_si;
    double factor = 1, offset = 0;
    signal->unit = slot != NULL ? slot->unit : lcd->base_unit;
    if (!jpk_lcd_chain(lcd, name, chain))
        return false;
    if (strcmp(signal->unit, wt_quantity_unit(signal->quantity)) != 0 &&
        wt_unit_to_si(signal->unit, signal->quantity, &factor, &offset, NULL) != WT_OK)
        return false;
    *chain = (force_linear){factor * chain->multiplier, factor * chain->offset + offset};
    return isfinite(chain->multiplier) && isfinite(chain->offset);
}

/* Sensitivity and spring constant are what the slots multiply by. */
static void add_calibration(const jpk_lcd *lcd, double volts, double deflection, double force,
                            wt_cantilever *cantilever)
{
    const jpk_slot *slot = jpk_lcd_slot(lcd, "force");
    const bool direct =
        slot != NULL && strcmp(slot->base, "distance") == 0 && strcmp(slot->unit, "N") == 0;
    cantilever->sensitivity = deflection / volts;
    cantilever->spring_constant = force / deflection;
    if (direct && !isnan(cantilever->spring_constant))
        cantilever->spring_constant = slot->scaling.multiplier;
}

void jpk_segment_facts(const jpk_segment *segment, force_facts *facts)
{
    double multiplier[WT_Q_COUNT];
    *facts =
        (force_facts){.kind = segment->kind,
                      .n_points = segment->n_points,
                      .duration = segment->duration,
                      .velocity = segment->velocity,
                      .setpoint = segment->setpoint_voltage,
                      .setpoint_quantity = WT_Q_DEFLECTION_VOLTAGE,
                      .n_offers = sizeof quantities / sizeof *quantities,
                      .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN}};
    memcpy(facts->offers, quantities, sizeof quantities);
    for (size_t i = 0; i < facts->n_offers; i++) {
        const wt_quantity q = quantities[i];
        const jpk_channel *c = jpk_segment_source(segment, q);
        multiplier[q] = (double)NAN;
        if (c == NULL)
            continue;
        force_signal signal = {
            .quantity = q, .channel = c, .name = c->name, .unit = "", .problem = c->problem};
        if (c->understood) {
            const bool known = chain_si(&c->lcd, &signal);
            if (!known && (q == WT_Q_FORCE || q == WT_Q_DEFLECTION))
                continue;
            signal.problem = known ? NULL : "it has no calibration";
            multiplier[q] = known ? signal.to_si.multiplier : (double)NAN;
        }
        force_add_signal(facts, signal);
    }
    const jpk_channel *deflection = jpk_segment_source(segment, WT_Q_FORCE);
    if (deflection != NULL && deflection->understood)
        add_calibration(&deflection->lcd, multiplier[WT_Q_DEFLECTION_VOLTAGE],
                        multiplier[WT_Q_DEFLECTION], multiplier[WT_Q_FORCE], &facts->cantilever);
}
