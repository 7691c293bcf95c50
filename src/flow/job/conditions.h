/* Material, roughness and conditions of one replicate of a sliding contact. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_CONDITIONS_H
#define WEARTRACK_FLOW_CONDITIONS_H

#include "weartrack/flow.h"

/* Relative numerical error asked of replicates: far below the scatter between them. */
#define FLOW_REPLICATE_TOLERANCE 1e-5

typedef struct flow_conditions {
    double pressure, shear_stress;
    wt_material *material;
    wt_roughness *roughness;
    wt_friction_workspace *workspace;
    char statement[256]; /* what must be said of the material, "" if nothing */
} flow_conditions;

/* Checks the numbers of a sliding contact and of the job. */
wt_status flow_sliding_check(const wt_sliding *sliding, const wt_job *work,
                             wt_error *err) WT_NODISCARD;
/* The velocity of the answer: as given, or the middle of the list. */
double flow_reference_velocity(const wt_sliding *sliding);
/* Draws replicate `replicate` (WT_NO_REPLICATE = the values themselves) and prepares the kernel. */
wt_status flow_conditions_make(const wt_sliding *sliding, uint64_t seed, size_t replicate,
                               double tolerance, unsigned threads, wt_layer_state layer,
                               flow_conditions *conditions, wt_error *err) WT_NODISCARD;
void flow_conditions_clear(flow_conditions *conditions);
/* What of the conditions has no stated error, as words. */
void flow_conditions_lack(const wt_sliding *sliding, char *words, size_t size);
/* Whether any error is stated or measured, and which, as words. The shear stress, which only the
 * total friction knows, is left to the caller in both. */
bool flow_conditions_vary(const wt_sliding *sliding, const wt_job *work, char *words, size_t size);

/* Appends `what` to a list of words parted by ", "; cut where there is no room. */
void flow_add_words(char *words, size_t size, const char *what);

#endif
