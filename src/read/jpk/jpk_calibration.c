/* JPK calibration: from volts of the detector to deflection and force, by the file or by the user.
 *
 * Signs are those of the file: force is positive when the sample pushes the tip away, the height
 * falls while the tip approaches.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"

#include <math.h>
#include <string.h>

static jpk_linear times(double factor, jpk_linear chain)
{
    return (jpk_linear){factor * chain.multiplier, factor * chain.offset};
}

/* A chain to `slot` in the SI unit of `quantity`. */
static bool chain_si(const jpk_lcd *lcd, const char *slot, wt_quantity quantity, jpk_linear *chain,
                     const char **unit)
{
    const jpk_slot *s = jpk_lcd_slot(lcd, slot);
    const char *text = s != NULL ? s->unit : lcd->base_unit;
    double factor = 1, offset = 0;
    if (!jpk_lcd_chain(lcd, slot, chain))
        return false;
    if (strcmp(text, wt_quantity_unit(quantity)) != 0 &&
        wt_unit_to_si(text, quantity, &factor, &offset, NULL) != WT_OK)
        return false;
    *chain = times(factor, *chain);
    chain->offset += offset;
    *unit = text;
    return isfinite(chain->multiplier) && isfinite(chain->offset);
}

void jpk_calibrate(const jpk_lcd *lcd, const wt_read_options *options, jpk_calibration *calibration)
{
    jpk_calibration c = {
        .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN}};
    const char *unit = NULL;
    jpk_linear volts;
    c.has_deflection = chain_si(lcd, "distance", WT_Q_DEFLECTION, &c.deflection, &unit);
    c.has_force = chain_si(lcd, "force", WT_Q_FORCE, &c.force, &unit);
    if (c.has_deflection)
        c.cantilever.sensitivity = c.deflection.multiplier;
    if (c.has_force && c.has_deflection) {
        const jpk_slot *force = jpk_lcd_slot(lcd, "force");
        bool direct = strcmp(force->base, "distance") == 0 && strcmp(force->unit, "N") == 0;
        c.cantilever.spring_constant =
            direct ? force->scaling.multiplier : c.force.multiplier / c.deflection.multiplier;
    }
    bool given = false;
    if (!isnan(options->sensitivity) &&
        chain_si(lcd, lcd->base, WT_Q_DEFLECTION_VOLTAGE, &volts, &unit)) {
        c.deflection = times(options->sensitivity, volts);
        c.has_deflection = true;
        c.cantilever.sensitivity = options->sensitivity;
        c.cantilever.sensitivity_given = true;
        given = true;
    }
    if (!isnan(options->spring_constant)) {
        c.cantilever.spring_constant = options->spring_constant;
        c.cantilever.spring_constant_given = true;
        given = true;
    }
    /* What the user gives replaces a link of the chain, so the force is computed anew. */
    if (given) {
        c.has_force = c.has_deflection && !isnan(c.cantilever.spring_constant);
        if (c.has_force)
            c.force = times(c.cantilever.spring_constant, c.deflection);
    }
    *calibration = c;
}

bool jpk_quantity_chain(const jpk_lcd *lcd, wt_quantity quantity,
                        const jpk_calibration *calibration, jpk_linear *chain, const char **unit)
{
    switch (quantity) {
    case WT_Q_FORCE:
        *chain = calibration->force;
        *unit = "N";
        return calibration->has_force;
    case WT_Q_DEFLECTION:
        *chain = calibration->deflection;
        *unit = "m";
        return calibration->has_deflection;
    case WT_Q_DEFLECTION_VOLTAGE:
    case WT_Q_LATERAL_DEFLECTION:
        return chain_si(lcd, lcd->base, quantity, chain, unit);
    default:
        return chain_si(lcd, lcd->preferred, quantity, chain, unit);
    }
}

wt_status jpk_uncalibrated(const jpk_calibration *calibration, wt_error *err)
{
    bool no_constant = isnan(calibration->cantilever.spring_constant);
    bool no_sensitivity = !calibration->has_deflection;
    const char *what = no_constant && no_sensitivity ? "spring constant and deflection sensitivity"
                       : no_constant                 ? "spring constant"
                                                     : "deflection sensitivity";
    wt_fail(err, WT_E_MISSING, "the file does not say the %s", what);
    wt_error_advice(err, "give %s%s%s", no_constant ? "--spring-constant 0.1N/m" : "",
                    no_constant && no_sensitivity ? " and " : "",
                    no_sensitivity ? "--sensitivity 120nm/V" : "");
    return WT_E_MISSING;
}
