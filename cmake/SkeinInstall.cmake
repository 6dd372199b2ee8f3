# Install rules; the exported package is added with them.
