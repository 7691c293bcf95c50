/* Input files that cases share: their errors are shared, and a shared measurement counts once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/collect.h"

#include "core/base/array.h"
#include "core/table/registry.h"

#include <math.h>
#include <string.h>

static file_match compare_input_rows(const table_view *a, size_t i, const table_view *b, size_t k)
{
    const char *inputs_a = inputs_text(a, i, INPUTS_SHA256),
               *inputs_b = inputs_text(b, k, INPUTS_SHA256);
    if (inputs_a[0] != '\0' && inputs_b[0] != '\0')
        return strcmp(inputs_a, inputs_b) == 0 ? FILES_IDENTICAL : FILES_DIFFERENT;
    if (inputs_get(a, i, INPUTS_BYTES) != inputs_get(b, k, INPUTS_BYTES))
        return FILES_DIFFERENT;
    return strcmp(inputs_text(a, i, INPUTS_PATH), inputs_text(b, k, INPUTS_PATH)) == 0
               ? FILES_SAME_NAME
               : FILES_SAME_SIZE;
}

static bool has_role(const table_view *inputs, size_t row, const char *role)
{
    return strcmp(inputs_text(inputs, row, INPUTS_ROLE), role) == 0;
}

static file_match compare_role(const table_view *a, const table_view *b, const char *role)
{
    file_match closest = FILES_DIFFERENT;
    for (size_t i = 0; i < a->n_rows; i++)
        for (size_t k = 0; k < b->n_rows && has_role(a, i, role); k++) {
            const file_match found =
                has_role(b, k, role) ? compare_input_rows(a, i, b, k) : FILES_DIFFERENT;
            closest = found > closest ? found : closest;
        }
    return closest;
}

static bool bind_inputs(const collected_case *c, table_view *inputs)
{
    return table_bind_result(c->result, &inputs_schema, "", inputs, NULL) == WT_OK &&
           inputs->table != NULL;
}

/* A result without a list of files may share any. */
file_match compare_input_files(const collected_case *a, const collected_case *b,
                               const char *const *roles, size_t n_roles)
{
    table_view inputs_a, inputs_b;
    file_match closest = FILES_DIFFERENT;
    if (!bind_inputs(a, &inputs_a) || !bind_inputs(b, &inputs_b))
        return FILES_SAME_SIZE;
    for (size_t i = 0; i < n_roles; i++) {
        const file_match found = compare_role(&inputs_a, &inputs_b, roles[i]);
        closest = found > closest ? found : closest;
    }
    return closest;
}

/* Prefix of the sources of each category (NULL if the table has none), and the roles of their
 * files. */
static const struct {
    const char *source;
    const char *roles[5];
} sources[INPUT_CATEGORIES] = {[SHARED_MATERIAL] = {VALIDATION_MATERIAL_PREFIX,
                                                    {"dma", "material", "topography", "roughness"}},
                               [SHARED_LAW] = {"shift law", {"dma", "material"}},
                               [SHARED_ROUGHNESS] = {"roughness", {"topography", "roughness"}},
                               [SHARED_SOFTENING] = {"softening with strain", {"softening", "dma"}},
                               [SHARED_SPECTRUM] = {NULL, {"dma", "material"}}};

input_category input_category_of_source(const char *source)
{
    input_category i = 0;
    while (i < INPUT_CATEGORIES &&
           (sources[i].source == NULL ||
            strncmp(source, sources[i].source, strlen(sources[i].source)) != 0))
        i++;
    return i;
}

double shared_covariance(const case_value *a, const case_value *b)
{
    double sum = 0;
    for (input_category i = 0; i < INPUT_CATEGORIES; i++) {
        const double closest = sqrt(a->by_files[i] * b->by_files[i]);
        size_t n = 0;
        while (n < COUNT_OF(sources[i].roles) && sources[i].roles[n] != NULL)
            n++;
        if (closest > 0 &&
            compare_input_files(a->of, b->of, sources[i].roles, n) != FILES_DIFFERENT)
            sum += closest;
    }
    return sum;
}

static bool has_input_role(const collected_case *c, const char *const *roles, size_t n)
{
    table_view inputs;
    bool any = false;
    if (!bind_inputs(c, &inputs))
        return false;
    for (size_t row = 0; row < inputs.n_rows; row++)
        for (size_t k = 0; k < n; k++)
            any = any || has_role(&inputs, row, roles[k]);
    return any;
}

bool inputs_may_be_shared(const collected_case *a, const collected_case *b)
{
    static const char *const roles[] = {"dma", "material", "topography", "roughness", "softening"};
    const size_t n = COUNT_OF(roles);
    return !has_input_role(a, roles, n) || !has_input_role(b, roles, n) ||
           compare_input_files(a, b, roles, n) != FILES_DIFFERENT;
}
