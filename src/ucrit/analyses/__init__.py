"""One file per question. An analysis knows no vehicle; it states what it needs of a model."""
