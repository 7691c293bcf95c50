/* Reads images of Asylum Research in Igor binary waves. Channels are stored one after another,
 * lines from the bottom upwards, lengths in metres.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/ibw/ibw.h"
#include "read/images.h"

#include <string.h>

/* Returns the unit of a channel by its name, such as "HeightRetrace" or "ZSensorTrace", since the
 * wave states none. */
static const char *channel_unit(const char *name)
{
    static const struct {
        const char *begin, *unit;
    } known[] = {{"Height", "m"},
                 {"ZSensor", "m"},
                 {"Deflection", "m"},
                 {"Amplitude", "m"},
                 {"Phase", "deg"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strncmp(name, known[i].begin, strlen(known[i].begin)) == 0)
            return known[i].unit;
    return "1";
}

wt_status ibw_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                     wt_log *log, wt_image **images, size_t *n_images, wt_error *err)
{
    ibw_file file;
    ibw_grid grid;
    image_list list = {NULL, 0};
    (void)self;
    (void)options;
    wt_status status = ibw_open_image(input, &file, &grid, err);
    for (size_t c = 0; status == WT_OK && c < file.n_channels; c++) {
        double *values = NULL;
        wt_image head = {.n_columns = grid.n_columns,
                         .n_rows = grid.n_rows,
                         .width = grid.step_x * (double)(grid.n_columns - 1),
                         .height = grid.step_y * (double)(grid.n_rows - 1),
                         .x_min = grid.x_min,
                         .y_min = grid.y_min,
                         .x_unit = "m"};
        snprintf(head.name, sizeof head.name, "%s", file.channels[c].name);
        snprintf(head.unit, sizeof head.unit, "%s", channel_unit(head.name));
        status = images_add(&list, &head, &values, err);
        if (status != WT_OK)
            break;
        samples_decode(file.type, file.big_endian,
                       file.bytes + file.data + sample_width(file.type) * c * file.n, file.n, 1, 0,
                       values);
    }
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}
