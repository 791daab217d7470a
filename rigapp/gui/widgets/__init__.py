"""Small parts that every panel is made of: labels, buttons, tables, bars. They know no test."""
