/* Input files that cases share: their errors are shared, and a shared measurement counts once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/collect.h"

#include "core/base/array.h"
#include "core/table/registry.h"

#include <math.h>
#include <string.h>

static files_common compare_files(const table_view *a, size_t i, const table_view *b, size_t k)
{
    const char *of_a = inputs_text(a, i, INPUTS_SHA256), *of_b = inputs_text(b, k, INPUTS_SHA256);
    if (of_a[0] != '\0' && of_b[0] != '\0')
        return strcmp(of_a, of_b) == 0 ? FILES_COMMON : FILES_APART;
    if (inputs_get(a, i, INPUTS_BYTES) != inputs_get(b, k, INPUTS_BYTES))
        return FILES_APART;
    return strcmp(inputs_text(a, i, INPUTS_PATH), inputs_text(b, k, INPUTS_PATH)) == 0
               ? FILES_OF_ONE_NAME
               : FILES_OF_ONE_SIZE;
}

static bool has_role(const table_view *inputs, size_t row, const char *role)
{
    return strcmp(inputs_text(inputs, row, INPUTS_ROLE), role) == 0;
}

static files_common compare_role(const table_view *a, const table_view *b, const char *role)
{
    files_common most = FILES_APART;
    for (size_t i = 0; i < a->n_rows; i++)
        for (size_t k = 0; k < b->n_rows && has_role(a, i, role); k++) {
            const files_common found =
                has_role(b, k, role) ? compare_files(a, i, b, k) : FILES_APART;
            most = found > most ? found : most;
        }
    return most;
}

static bool inputs_of(const collected_case *c, table_view *inputs)
{
    return table_bind_of(c->result, &inputs_schema, "", inputs, NULL) == WT_OK &&
           inputs->table != NULL;
}

/* A result without a list of files may share any. */
files_common files_in_common(const collected_case *a, const collected_case *b,
                             const char *const *roles, size_t n_roles)
{
    table_view of_a, of_b;
    files_common most = FILES_APART;
    if (!inputs_of(a, &of_a) || !inputs_of(b, &of_b))
        return FILES_OF_ONE_SIZE;
    for (size_t i = 0; i < n_roles; i++) {
        const files_common found = compare_role(&of_a, &of_b, roles[i]);
        most = found > most ? found : most;
    }
    return most;
}

/* Prefix of the sources of each category (NULL if the table has none), and the roles of their
 * files. */
static const struct {
    const char *source;
    const char *roles[5];
} sources[SHARED_FILES_N] = {
    [SHARED_MATERIAL] = {VALIDATION_OF_MATERIAL, {"dma", "material", "topography", "roughness"}},
    [SHARED_LAW] = {"shift law", {"dma", "material"}},
    [SHARED_ROUGHNESS] = {"roughness", {"topography", "roughness"}},
    [SHARED_SOFTENING] = {"softening with strain", {"softening", "dma"}},
    [SHARED_SPECTRUM] = {NULL, {"dma", "material"}}};

shared_files shared_files_of(const char *source)
{
    shared_files i = 0;
    while (i < SHARED_FILES_N &&
           (sources[i].source == NULL ||
            strncmp(source, sources[i].source, strlen(sources[i].source)) != 0))
        i++;
    return i;
}

double shared_covariance(const case_value *a, const case_value *b)
{
    double sum = 0;
    for (shared_files i = 0; i < SHARED_FILES_N; i++) {
        const double most = sqrt(a->by_files[i] * b->by_files[i]);
        size_t n = 0;
        while (n < COUNT_OF(sources[i].roles) && sources[i].roles[n] != NULL)
            n++;
        if (most > 0 && files_in_common(a->of, b->of, sources[i].roles, n) != FILES_APART)
            sum += most;
    }
    return sum;
}

static bool has_any(const collected_case *c, const char *const *roles, size_t n)
{
    table_view inputs;
    bool any = false;
    if (!inputs_of(c, &inputs))
        return false;
    for (size_t row = 0; row < inputs.n_rows; row++)
        for (size_t k = 0; k < n; k++)
            any = any || has_role(&inputs, row, roles[k]);
    return any;
}

bool inputs_may_be_common(const collected_case *a, const collected_case *b)
{
    static const char *const roles[] = {"dma", "material", "topography", "roughness", "softening"};
    const size_t n = COUNT_OF(roles);
    return !has_any(a, roles, n) || !has_any(b, roles, n) ||
           files_in_common(a, b, roles, n) != FILES_APART;
}
