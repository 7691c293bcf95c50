/* Names of tables, columns and keys that changed in version 0.9.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/former_names.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/table/table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Tables, and figures that have the name of their table. */
static const struct {
    const char *former, *name;
} tables[] = {
    {"choices", "overrides"},
    {"common_law", "shared_shift_law"},
    {"directions", "transverse_isotropy"},
    {"existence", "layer_regime_map"},
    {"existence_friction", "layer_regime_map_friction"},
    {"existence_thickness", "layer_regime_map_thickness"},
    {"layer_balances", "layer_feedback"},
};

/* A former name that ends in '_' stands for all names that begin with it. */
static const struct {
    const char *table; /* name of today of the table; NULL: any table */
    const char *former, *name;
} members[] = {
    {"angular_spectrum", "chance", "p_value"},
    {"angular_spectrum", "chance_fourth", "p_value_fourth"},
    {"cost", "because", "reason"},
    {"error_budget", "lacks", "excluded_errors"},
    {"modulus_depth", "chance_", "p_value_"},
    {"plan", "because", "reason"},
    {"plan", "gives", "produces"},
    {"prony_reduced", "better", "preferred_model"},
    {"shared_shift_law", "furthest", "largest_deviation"},
    {"validation_choices", "tried", "alternative"},
    {"what_if", "tried", "alternative"},
    {NULL, "anisotropy_chance", "anisotropy_p"},
    {NULL, "baseline_chance", "baseline_p"},
    {NULL, "each_moved", "sample_shifts"},
    {NULL, "first_appearance", "onset_time"},
    {NULL, "holds_from", "valid_from"},
    {NULL, "holds_to", "valid_to"},
    {NULL, "interval_lacks", "interval_excludes"},
    {NULL, "lack_of_fit_chance", "lack_of_fit_p"},
    {NULL, "misfit_chance", "misfit_p"},
    {NULL, "misfit_chance_", "misfit_p_"},
    {NULL, "pooled_misfit_chance", "pooled_misfit_p"},
    {NULL, "standard_error_lacks", "standard_error_excludes"},
    {NULL, "ways_error", "direction_error"},
};

const char *table_current_name(const char *name)
{
    for (size_t i = 0; i < COUNT_OF(tables); i++)
        if (strcmp(tables[i].former, name) == 0)
            return tables[i].name;
    return name;
}

/* Replaces *name if it is a former name of a column or key of the table. */
static void replace_member(const char *table, char **name)
{
    for (size_t i = 0; i < COUNT_OF(members); i++) {
        const size_t n = strlen(members[i].former);
        const bool is_prefix = members[i].former[n - 1] == '_';
        if ((members[i].table != NULL && strcmp(members[i].table, table) != 0) ||
            strncmp(members[i].former, *name, n) != 0 || (!is_prefix && (*name)[n] != '\0'))
            continue;
        char *current = NULL;
        if (asprintf(&current, "%s%s", members[i].name, *name + n) < 0)
            out_of_memory(n);
        free(*name);
        *name = current;
        return;
    }
}

void table_use_current_names(wt_table *table)
{
    const char *current = table_current_name(table->name);
    if (current != table->name) {
        free(table->name);
        table->name = wt_strdup(current);
    }
    for (size_t i = 0; i < table->n_columns; i++)
        replace_member(table->name, &table->columns[i].name);
    for (size_t i = 0; i < table->n_keys; i++)
        replace_member(table->name, &table->keys[i].name);
}
