/* Derives voltage, deflection, force and height from the numbers of a JPK channel, by its
 * calibration slots.
 *
 * Signs are those of the file: the force is positive when the sample repels the tip. The height
 * decreases while the tip approaches.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"

#include <math.h>
#include <string.h>

/* Slots that each channel names itself. */
#define BASE_SLOT NULL
#define PREFERRED_SLOT ""

/* The quantities with their channel and calibration slot, in the order of the columns. Of several
 * height sensors the first that is understood is used; the instrument itself works with it. */
static const struct {
    wt_quantity quantity;
    const char *channel, *slot;
} sources[] = {
    {WT_Q_HEIGHT, "height", PREFERRED_SLOT},
    {WT_Q_FORCE, "vDeflection", "force"},
    {WT_Q_DEFLECTION, "vDeflection", "distance"},
    {WT_Q_DEFLECTION_VOLTAGE, "vDeflection", BASE_SLOT},
    {WT_Q_MEASURED_HEIGHT, "measuredHeight", PREFERRED_SLOT},
    {WT_Q_MEASURED_HEIGHT, "capacitiveSensorHeight", PREFERRED_SLOT},
    {WT_Q_MEASURED_HEIGHT, "strainGaugeHeight", PREFERRED_SLOT},
    {WT_Q_MEASURED_HEIGHT, "smoothedMeasuredHeight", PREFERRED_SLOT},
    {WT_Q_LATERAL_DEFLECTION, "hDeflection", BASE_SLOT},
};

/* Computes the conversion to a slot in the SI unit of the quantity; false if the file does not
 * define it. */
static bool chain_to_si(const jpk_lcd *lcd, const char *name, force_signal *signal)
{
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

static void add_signal(const jpk_channel *c, wt_quantity quantity, const char *slot,
                       force_metadata *metadata)
{
    force_signal signal = {
        .quantity = quantity, .channel = c, .name = c->name, .unit = "", .problem = c->problem};
    if (c->understood) {
        const bool is_named = slot != BASE_SLOT && *slot != '\0';
        const char *name = slot == BASE_SLOT ? c->lcd.base : is_named ? slot : c->lcd.preferred;
        const bool known = chain_to_si(&c->lcd, name, &signal);
        if (!known && is_named)
            return;
        signal.problem = known ? NULL : "it has no calibration";
    }
    force_add_signal(metadata, signal);
}

static double multiplier(const force_metadata *metadata, wt_quantity quantity)
{
    const force_signal *signal = force_find_signal(metadata, quantity);
    return signal != NULL && signal->problem == NULL ? signal->to_si.multiplier : (double)NAN;
}

/* Sets sensitivity and spring constant, which are the multipliers of the slots. */
static void set_calibration(const jpk_lcd *lcd, force_metadata *metadata)
{
    const jpk_slot *slot = jpk_lcd_slot(lcd, "force");
    const bool direct =
        slot != NULL && strcmp(slot->base, "distance") == 0 && strcmp(slot->unit, "N") == 0;
    const double deflection = multiplier(metadata, WT_Q_DEFLECTION);
    const double force = multiplier(metadata, WT_Q_FORCE);
    metadata->cantilever.sensitivity = deflection / multiplier(metadata, WT_Q_DEFLECTION_VOLTAGE);
    metadata->cantilever.spring_constant = force / deflection;
    if (direct && !isnan(metadata->cantilever.spring_constant))
        metadata->cantilever.spring_constant = slot->scaling.multiplier;
}

void jpk_segment_metadata(const jpk_segment *segment, force_metadata *metadata)
{
    *metadata = (force_metadata){
        .kind = segment->kind,
        .n_points = segment->n_points,
        .duration = segment->duration,
        .velocity = segment->velocity,
        .frequency = segment->frequency,
        .setpoint = segment->setpoint_voltage,
        .setpoint_quantity = WT_Q_DEFLECTION_VOLTAGE,
        .offers = {WT_Q_TIME},
        .n_offers = 1,
        .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN}};
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++) {
        const wt_quantity q = sources[i].quantity;
        const jpk_channel *c = jpk_segment_channel(segment, sources[i].channel);
        force_add_offer(metadata, q);
        if (c != NULL && (c->understood || q != WT_Q_MEASURED_HEIGHT))
            add_signal(c, q, sources[i].slot, metadata);
    }
    const jpk_channel *deflection = jpk_segment_channel(segment, "vDeflection");
    if (deflection != NULL && deflection->understood)
        set_calibration(&deflection->lcd, metadata);
}
