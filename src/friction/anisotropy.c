/* Effect of the sliding direction on anisotropic roughness: hysteresis friction, contact area and
 * lateral force with the anisotropy, and the first two without it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/anisotropy.h"
#include "friction/friction_difference.h"
#include "friction/numerics/angular_weight.h"

#include "core/base/clocale.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <string.h>

/* Row of the table: both results at one velocity. */
TABLE_ROW(anisotropy, ANISOTROPY, wt_friction_point with, without;)

TABLE_KEYS(anisotropy, ANISOTROPY, char texture[192], effect[320]; wt_estimate side;)

void anisotropy_describe(const wt_anisotropy *anisotropy, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS && used < size; k++)
        if (anisotropy->amplitude[k] != 0) {
            clocale_print(text + used, size - used, "%s%.4g cos %zu(phi - %.4g deg)",
                          used > 0 ? " + " : "", anisotropy->amplitude[k], 2 * (k + 1),
                          anisotropy->angle[k] * 180 / M_PI);
            used = strlen(text);
        }
}

static void describe_effect(const wt_friction_point *with, const wt_friction_point *without,
                            char *text, size_t size)
{
    char against[128];
    clocale_print(against, sizeof against,
                  "roughness that is the same in all directions; the force of the hysteresis turns "
                  "by %.1f deg to the side",
                  atan2(with->lateral.value, with->hysteresis.value) * 180 / M_PI);
    friction_difference_describe(with, without, against, text, size);
}

static wt_status tabulate_anisotropy(const friction_difference *c, wt_table **table, wt_error *err)
{
    const size_t n = c->n - 1;
    table_writer t = table_begin(&anisotropy_schema, err);
    for (size_t i = 0; i < n; i++)
        TABLE_ADD(anisotropy, &t, c->with[i], c->without[i]);
    anisotropy_keys keys = {.side = c->with[n].lateral};
    keys.side.standard_error = (double)NAN; /* this table draws no replicates */
    anisotropy_describe(&c->sliding->anisotropy, keys.texture, sizeof keys.texture);
    describe_effect(&c->with[n], &c->without[n], keys.effect, sizeof keys.effect);
    anisotropy_set_keys(&t, &keys);
    return table_end(&t, table);
}

wt_status wt_anisotropic_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                          wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no anisotropy to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && !anisotropy_is_present(&sliding->anisotropy))
        status = wt_fail(err, WT_E_ARG, "the roughness is the same in all directions");
    if (status != WT_OK)
        return status;
    friction_difference c;
    wt_sliding without = *sliding;
    without.anisotropy = (wt_anisotropy){{0}, {0}};
    status = friction_difference_compute(sliding, &without, work, NULL, NULL, &c, err);
    if (status == WT_OK)
        status = tabulate_anisotropy(&c, table, err);
    friction_difference_clear(&c);
    return status;
}
