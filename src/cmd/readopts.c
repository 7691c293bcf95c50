/* Options about reading instrument files. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "cmd/readopts.h"

void cmd_read_values_init(cmd_read_values *values)
{
    *values = (cmd_read_values){(double)NAN, (double)NAN, (double)NAN, {NULL, 0}};
}

void cmd_read_values_free(cmd_read_values *values)
{
    cmd_list_free(&values->units);
}

size_t cmd_read_force_options(cmd_read_values *values, cmd_option *options)
{
    options[0] = (cmd_option){"spring-constant",
                              0,
                              CMD_QUANTITY,
                              &values->spring_constant,
                              "K",
                              WT_Q_SPRING_CONSTANT,
                              "spring constant, such as 0.1N/m; replaces that of the files"};
    options[1] = (cmd_option){"sensitivity",
                              0,
                              CMD_QUANTITY,
                              &values->sensitivity,
                              "S",
                              WT_Q_SENSITIVITY,
                              "deflection sensitivity, such as 120nm/V; replaces the files'"};
    return 2;
}

size_t cmd_read_dma_options(cmd_read_values *values, cmd_option *options)
{
    options[0] = (cmd_option){"temperature",
                              0,
                              CMD_QUANTITY,
                              &values->temperature,
                              "T",
                              WT_Q_TEMPERATURE,
                              "temperature of files that say none, such as 20degC"};
    return 1;
}

size_t cmd_read_units_option(cmd_read_values *values, cmd_option *options)
{
    options[0] = (cmd_option){"units",
                              0,
                              CMD_LIST,
                              &values->units,
                              "NAME=UNIT",
                              WT_Q_NONE,
                              "unit of a column that carries none, such as \"E'=MPa\"; repeatable"};
    return 1;
}

wt_read_options cmd_read_make(const cmd_read_values *values, const cmd_common *common)
{
    wt_read_options options = wt_read_defaults();
    options.format = common->format;
    options.spring_constant = values->spring_constant;
    options.sensitivity = values->sensitivity;
    options.temperature = values->temperature;
    options.units = values->units.items;
    options.n_units = values->units.n;
    return options;
}

int cmd_check_format(const char *name, const cmd_common *common, const wt_formats *formats)
{
    if (common->format == NULL || wt_formats_find(formats, common->format) != NULL)
        return CMD_OK;
    return cmd_usage_error(name, "--format: there is no format '%s', see weartrack formats list",
                           common->format);
}
